// Fonts that are there before the page is drawn. From a style sheet they would come after the text has
// been set with others, and move it. The build puts names, files and styles here.
for (const [family, data, style] of FONTS) {
  const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
  document.fonts.add(new FontFace(family, bytes.buffer, style));
}
