// What is drawn on a canvas, as SVG: stands in for its context and for Path2D, as far as the
// pictures of a run use them.

const kSpace = "http://www.w3.org/2000/svg";

const rounded = (value) => Number(value.toFixed(4)); // 0.1 mm of the world

export class SvgPath {
  d = "";

  moveTo(x, y) {
    this.d += `M${rounded(x)} ${rounded(y)}`;
  }

  lineTo(x, y) {
    this.d += `L${rounded(x)} ${rounded(y)}`;
  }

  closePath() {
    this.d += "Z";
  }

  /// A whole circle: no other arc is drawn.
  arc(x, y, radius) {
    const [r, across] = [rounded(radius), rounded(2 * radius)];
    this.moveTo(x - radius, y);
    this.d += `a${r} ${r} 0 1 0 ${across} 0a${r} ${r} 0 1 0 ${-across} 0Z`;
  }
}

export class SvgContext {
  constructor(width, height) {
    this.image = this.made("svg", { width, height, viewBox: `0 0 ${width} ${height}` });
    this.pen = document.createElement("canvas").getContext("2d"); // measures text
    this.saved = [];
    const font = this.pen.font;
    this.state = { matrix: new DOMMatrix(), dashes: [], globalAlpha: 1, lineWidth: 1, font };
  }

  made(tag, attributes) {
    const element = document.createElementNS(kSpace, tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    return element;
  }

  /// @param attributes  besides those of the state
  add(tag, attributes, text = "") {
    const { matrix, globalAlpha } = this.state;
    const { a, b, c, d, e, f } = matrix;
    const element = this.made(tag, {
      ...attributes,
      opacity: globalAlpha,
      transform: `matrix(${[a, b, c, d, e, f].map(rounded).join(" ")})`,
    });
    element.textContent = text;
    this.image.append(element);
  }

  save() {
    this.saved.push({ ...this.state });
  }

  restore() {
    this.state = this.saved.pop();
  }

  transform(...matrix) {
    this.state.matrix = this.state.matrix.multiply(new DOMMatrix(matrix));
  }

  scale(x, y) {
    this.transform(x, 0, 0, y, 0, 0);
  }

  setLineDash(dashes) {
    this.state.dashes = dashes;
  }

  get line() {
    const { strokeStyle: stroke, lineWidth, lineJoin, dashes } = this.state;
    const line = { fill: "none", stroke, "stroke-width": lineWidth };
    line["stroke-linejoin"] = lineJoin || "miter";
    if (dashes.length) line["stroke-dasharray"] = dashes.join(" ");
    return line;
  }

  stroke({ d }) {
    this.add("path", { d, ...this.line });
  }

  fill({ d }) {
    this.add("path", { d, fill: this.state.fillStyle });
  }

  fillRect(x, y, width, height) {
    this.add("rect", { x, y, width, height, fill: this.state.fillStyle });
  }

  fillText(text, x, y) {
    this.write(text, x, y, { fill: this.state.fillStyle });
  }

  strokeText(text, x, y) {
    this.write(text, x, y, this.line);
  }

  measureText(text) {
    this.pen.font = this.state.font;
    return this.pen.measureText(text);
  }

  /// On the alphabetic baseline, wherever the state has it: programs differ in the others.
  write(text, x, y, paint) {
    const { font, textAlign, textBaseline } = this.state;
    this.pen.font = font;
    const [asked, drawn] = [textBaseline || "alphabetic", "alphabetic"].map((baseline) => {
      this.pen.textBaseline = baseline;
      return this.pen.measureText(text).fontBoundingBoxAscent;
    });
    const [, weight, size, family] = /^(\d+) ([\d.]+px) (.+)$/.exec(font);
    const anchor = { center: "middle", right: "end" }[textAlign] || "start";
    this.add("text", {
      x: rounded(x),
      y: rounded(y + drawn - asked),
      "font-family": family,
      "font-size": size,
      "font-weight": weight,
      "text-anchor": anchor,
      ...paint,
    }, text);
  }
}

/// What a context keeps as plain values.
for (const name of [
  "globalAlpha", "fillStyle", "strokeStyle", "lineWidth", "lineJoin", "font", "textAlign",
  "textBaseline",
]) {
  Object.defineProperty(SvgContext.prototype, name, {
    get() {
      return this.state[name];
    },
    set(value) {
      this.state[name] = value;
    },
  });
}
