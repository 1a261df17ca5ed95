// Sphinx's search shows the highest score first: what is written for readers comes before the package.
window.Scorer = {
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
  score: ([page, , , , score]) => score - (page === "book/reference" || page === "book/references" ? 200 : 0),
};
