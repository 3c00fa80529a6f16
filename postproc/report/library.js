"use strict";
// The table of the library: search, filter, sort; one entity in full, or two side by side, with their curves.
const library = JSON.parse(document.getElementById("data").textContent);
const state = { kind: "fabric", sort: null, down: false, shown: null, compared: [] };
const at = (id) => document.getElementById(id);

function element(name, text, attributes) {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  for (const [key, value] of Object.entries(attributes || {})) made.setAttribute(key, value);
  return made;
}
const first = (entity, item) => entity.data.find((datum) => datum.name === item);
const ofKind = () => library.entities.filter((entity) => entity.kind === state.kind);

/// Items with numbers, those that most entities have first; each with the unit that it was first printed in.
function itemsOf(entities) {
  const items = new Map();
  for (const entity of entities)
    for (const datum of entity.data)
      if (datum.si !== null && first(entity, datum.name) === datum) {
        const item = items.get(datum.name) || { name: datum.name, unit: datum.unit, factor: datum.factor, count: 0 };
        item.count += 1;
        items.set(datum.name, item);
      }
  return [...items.values()].sort((a, b) => b.count - a.count);
}

function fits(entity) {
  const words = at("text").value.toLowerCase().split(/\s+/).filter((word) => word);
  const all = [entity.id, entity.parent, ...entity.data.flatMap((datum) => [datum.name, datum.printed, datum.source])].join(" ").toLowerCase();
  if (!words.every((word) => all.includes(word))) return false;
  const from = at("from").value, to = at("to").value;
  if (!at("item").value || (from === "" && to === "")) return true;
  const item = itemsOf(ofKind()).find((one) => one.name === at("item").value), datum = first(entity, item.name);
  if (!datum || datum.si === null) return false;
  const value = datum.si / item.factor, slack = 1e-12 * Math.abs(value);
  return (from === "" || value >= Number(from) - slack) && (to === "" || value <= Number(to) + slack);
}

function compareBy(item) {
  const value = (entity) => (item === "id" ? entity.id : (first(entity, item) || { si: null }).si);
  return (a, b) => {
    const x = value(a), y = value(b);
    if (x === y) return 0;
    if (x === null || x === undefined) return 1;  // what has no number stands last either way
    if (y === null || y === undefined) return -1;
    return (x < y ? -1 : 1) * (state.down ? -1 : 1);
  };
}

function draw() {
  const columns = itemsOf(ofKind()).slice(0, 8).map((item) => item.name);
  const head = element("tr");
  head.append(element("th"));
  for (const name of ["id", ...columns]) {
    const cell = element("th", undefined, { scope: "col", "aria-sort": state.sort === name ? (state.down ? "descending" : "ascending") : "none" });
    const button = element("button", (name === "id" ? "name" : name) + (state.sort === name ? (state.down ? " ▾" : " ▴") : ""), { type: "button", "data-sort": name });
    button.addEventListener("click", () => {
      state.down = state.sort === name && !state.down;
      state.sort = name;
      draw();
    });
    cell.append(button);
    head.append(cell);
  }
  at("table").tHead.replaceChildren(head);
  const found = ofKind().filter(fits);
  if (state.sort) found.sort(compareBy(state.sort));
  at("table").tBodies[0].replaceChildren(...found.map((entity) => row(entity, columns)));
  at("count").textContent = `${found.length} of ${ofKind().length}`;
}

function row(entity, columns) {
  const line = element("tr", undefined, { "data-id": entity.id });
  if (state.shown === entity || state.compared.includes(entity)) line.className = "shown";
  const tick = element("input", undefined, { type: "checkbox", "aria-label": "compare " + entity.id });
  tick.checked = state.compared.includes(entity);
  tick.addEventListener("change", () => {
    state.compared = state.compared.filter((one) => one !== entity);
    if (tick.checked) state.compared = [...state.compared, entity].slice(-2);
    state.shown = null;
    draw();
    show();
  });
  const box = element("td"), name = element("td"), link = element("a", entity.id, { href: "#detail" });
  box.append(tick);
  link.addEventListener("click", (event) => {
    event.preventDefault();
    state.shown = entity;
    state.compared = [];
    draw();
    show();
    at("detail").scrollIntoView();
  });
  name.append(link);
  if (entity.own) name.append(" ", element("small", "own"));
  line.append(box, name, ...columns.map((item) => element("td", (first(entity, item) || { printed: "" }).printed)));
  return line;
}

function show() {
  const entities = state.shown ? [state.shown] : state.compared;
  at("detail").hidden = entities.length === 0;
  const parts = [element("h2", entities.map((entity) => entity.id).join(" and "))];
  if (entities.length === 1 && !state.shown) parts.push(element("p", "Tick a second one to compare.", { class: "note" }));
  const table = element("table", undefined, { id: "values" }), head = element("tr");
  head.append(element("th", "item"), ...entities.flatMap((entity) => [element("th", entity.id, { class: "text" }), element("th", "source", { class: "text" })]));
  table.append(element("thead"), element("tbody"));
  table.tHead.append(head);
  const names = [...new Set(entities.flatMap((entity) => entity.data.map((datum) => datum.name)))];
  for (const name of names) {
    const most = Math.max(...entities.map((entity) => entity.data.filter((datum) => datum.name === name).length));
    for (let n = 0; n < most; ++n) {
      const line = element("tr");
      line.append(element("th", n ? "" : name, { scope: "row" }));
      for (const entity of entities) {
        const datum = entity.data.filter((one) => one.name === name)[n];
        line.append(element("td", datum ? datum.printed : "", { class: "text" }), element("td", datum ? datum.source : "", { class: "text note" }));
      }
      table.tBodies[0].append(line);
    }
  }
  const box = element("div", undefined, { class: "scroll" });
  box.append(table);
  const plots = element("div", undefined, { class: "plots" });
  for (const test of [...new Set(entities.flatMap((entity) => entity.curves.map((curve) => curve.test)))]) plots.append(figure(entities, test));
  at("detail").replaceChildren(...parts, plots, box);
}

const svg = (name, attributes, text) => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
};

/// Round steps that divide a length into some five parts.
function ticks(low, high) {
  const raw = (high - low) / 5 || 1, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * power).find((k) => k >= raw);
  const list = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) list.push(Number((k * step).toPrecision(10)));
  return list;
}

function figure(entities, test) {
  const curves = entities.flatMap((entity, n) => entity.curves.filter((curve) => curve.test === test).map((curve) => ({ ...curve, who: n ? "two" : "one" })));
  const xs = curves.flatMap((curve) => curve.points.map((point) => point[0])), ys = curves.flatMap((curve) => curve.points.map((point) => point[1]));
  const box = { left: Math.min(0, ...xs), right: Math.max(...xs), low: Math.min(0, ...ys), high: Math.max(...ys) };
  const width = 460, height = 300, x = (v) => 60 + ((v - box.left) / (box.right - box.left || 1)) * (width - 75), y = (v) => height - 40 - ((v - box.low) / (box.high - box.low || 1)) * (height - 55);
  const plot = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "plot", role: "img", "aria-label": test });
  for (const v of ticks(box.left, box.right)) plot.append(svg("line", { class: "grid", x1: x(v), x2: x(v), y1: y(box.low), y2: y(box.high) }), svg("text", { class: "tick", x: x(v), y: height - 22, "text-anchor": "middle" }, v));
  for (const v of ticks(box.low, box.high)) plot.append(svg("line", { class: "grid", y1: y(v), y2: y(v), x1: x(box.left), x2: x(box.right) }), svg("text", { class: "tick", x: 54, y: y(v) + 4, "text-anchor": "end" }, v));
  for (const curve of curves) {
    const path = (points) => "M" + points.map((p) => `${x(p[0]).toFixed(2)} ${y(p[1]).toFixed(2)}`).join("L");
    const inside = curve.points.filter((p) => !p[2]), last = curve.points.findLastIndex((p) => !p[2]), after = curve.points.slice(last);
    const line = svg("path", { d: path(inside), class: `curve ${curve.who}${curve.name.includes("unloading") ? " back" : ""}` });
    line.append(svg("title", {}, curve.name));
    plot.append(line);
    if (last >= 0 && after.length > 1) plot.append(svg("path", { d: path(after), class: `curve beyond ${curve.who}` }));
  }
  plot.append(svg("text", { x: width - 15, y: height - 5, "text-anchor": "end" }, curves[0].x), svg("text", { x: 5, y: 12 }, curves[0].y));
  const whole = element("figure"), caption = element("figcaption", test + " ");
  entities.forEach((entity, n) => caption.append(element("span", undefined, { class: n ? "swatch two" : "swatch" }), entity.id + " "));
  whole.append(caption, plot);
  return whole;
}

function fillChoices() {
  at("kind").replaceChildren(...[...new Set(library.entities.map((entity) => entity.kind))].map((kind) => element("option", kind, { value: kind })));
  if (!library.entities.some((entity) => entity.kind === state.kind)) state.kind = at("kind").value;
  at("kind").value = state.kind;
  fillItems();
}
function fillItems() {
  at("item").replaceChildren(element("option", "–", { value: "" }), ...itemsOf(ofKind()).map((item) => element("option", item.name, { value: item.name })));
  at("unit").textContent = "";
}

for (const id of ["text", "from", "to"]) at(id).addEventListener("input", draw);
at("item").addEventListener("change", () => {
  const item = itemsOf(ofKind()).find((one) => one.name === at("item").value);
  at("unit").textContent = item ? item.unit : "";
  draw();
});
at("kind").addEventListener("change", () => {
  Object.assign(state, { kind: at("kind").value, sort: null, down: false, shown: null, compared: [] });
  at("from").value = at("to").value = "";
  fillItems();
  draw();
  show();
});
fillChoices();
draw();
