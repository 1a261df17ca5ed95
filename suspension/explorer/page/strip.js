// The whole road in small, with the robot's place on it: for a picture that moves along.

const HIGH = 9; // pixels, of the road's highest place

/** Above a picture on the right, w pixels wide; no word goes there. */
export function drawStrip({ w, stroke, fill, line, reserve }, { data, road, settings }, X) {
  const [rear, front] = data.wheels,
    [start, end] = [rear, data.distance + front],
    width = Math.min(0.36 * w, 200),
    left = w - width - 2,
    bottom = 14;
  const px = (x) => left + (width * (x - start)) / (end - start);
  const points = [],
    spot = new Float64Array(4);
  for (let x = 0; x <= width; x += 2) {
    road(start + ((end - start) * x) / width, spot, 0, 0);
    points.push(spot[0]);
  }
  const most = Math.max(...points.map(Math.abs)) || 1,
    shape = new Path2D();
  points.forEach((y, n) => shape.lineTo(left + 2 * n, bottom - (HIGH * y) / most));
  stroke("soft", 1.2, [], shape);
  shape.lineTo(px(end), bottom + 3);
  shape.lineTo(left, bottom + 3);
  if (settings.height || !data.hasBump) fill("ground", 1, shape);
  reserve(left - 6, bottom - HIGH, w, bottom + 7);
  stroke("ink", 4);
  line(px(X + rear), bottom + 5, px(X + front), bottom + 5);
}
