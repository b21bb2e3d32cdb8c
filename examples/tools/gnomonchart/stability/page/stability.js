// The page of gnomonchart --stability: the heat map, the table, and the window of one cell. All text from the results enters
// the document as text, never as markup.
"use strict";
$(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const scenes = new Map(data.scenes.map(scene => [scene.id, scene]));
  const dialog = document.getElementById("cell");
  const names = ["scene", "kit", "technique", "setting", "outcome"];
  const signs = { "held": "", "stated limit": "/", "elsewhere": "·", "left": "", "catastrophe": "×" };

  function svg(name, attributes, text = "") {
    const element = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.textContent = text;
    return element;
  }

  const labelOf = row => row.technique + (row.setting === "defaults" ? "" : `, ${row.setting}`);
  const valueOf = (scene, place) => `${scene.values[place]} ${scene.unit}`.trim();

  // The heat map --------------------------------------------------------------------------------------------------

  const lines = new Map();
  data.rows.forEach((row, number) => {
    const key = `${row.kit} ${labelOf(row)}`;
    if (!lines.has(key)) lines.set(key, new Map());
    lines.get(key).set(row.scene, number);
  });

  function heatCell(number, newSection) {
    const cell = made("td");
    if (newSection) cell.classList.add("section");
    if (number === undefined) return cell;
    const row = data.rows[number];
    cell.textContent = signs[row.outcome];
    cell.style.background = row.colour;
    cell.tabIndex = 0;
    cell.dataset.number = number;
    cell.title = `${labelOf(row)}, ${scenes.get(row.scene).title}: ${row.outcome}`;
    return cell;
  }

  const begins = data.scenes.map((scene, i) => i > 0 && data.scenes[i - 1].section !== scene.section);
  const head = made("tr", "", made("th"), ...data.scenes.map(scene => made("th", `${scene.id} ${scene.title}`)));
  document.getElementById("heat").append(made("thead", "", head), made("tbody", "", ...[...lines].map(([key, cells]) => {
    const first = data.rows[cells.values().next().value];
    const line = made("tr", "", made("th", labelOf(first)),
      ...data.scenes.map((scene, i) => heatCell(cells.get(scene.id), begins[i])));
    line.classList.toggle("gnomon", first.kit === "Gnomon");
    return line;
  })));

  // The table -----------------------------------------------------------------------------------------------------

  const plain = $.fn.dataTable.render.text(); // escapes markup
  const last = row => row.cells[row.cells.length - 1];
  const atLeft = row => row.left === null ? null : row.cells[row.left];
  const numbers = [
    ["reach<span class=\"unit\">share of the sweep</span>", row => row.reach],
    ["p95 where left<span class=\"unit\">px</span>", row => atLeft(row) ? atLeft(row).all.p95 : null],
    ["wrong where left<span class=\"unit\">px</span>", row => atLeft(row) ? atLeft(row).all.wrong : null],
    ["IoU where left", row => atLeft(row) ? atLeft(row).all.iou : null],
    ["IoU at the end", row => last(row).failure ? null : last(row).all.iou],
    ["flicker", row => row.flicker],
    ["edge crawl<span class=\"unit\">px, beyond rays</span>", row => row.crawl]
  ];
  const columns = names.map(name => ({ title: name, data: name, render: plain }));
  columns.push({ title: "left at", data: row => row.left === null ? "–" : valueOf(scenes.get(row.scene), row.left),
    render: plain, orderable: false });
  for (const [title, value] of numbers) columns.push(measuredColumn(title, value));

  const table = $("#table").DataTable({
    data: data.rows.map((row, number) => Object.assign(row, { number })),
    columns, paging: false, order: [], orderClasses: false, autoWidth: false,
    language: { search: "Search in all columns ", info: "_TOTAL_ cells", infoEmpty: "no cells", infoFiltered: "of _MAX_",
      zeroRecords: "No cell matches.", emptyTable: "Nothing was measured." },
    createdRow: (line, row) => {
      line.tabIndex = 0;
      line.classList.toggle("gnomon", row.kit === "Gnomon");
      line.classList.toggle("bad", row.outcome === "catastrophe");
      line.dataset.number = row.number;
    }
  });

  const selects = Object.fromEntries($("#filters select").toArray().map(select => [select.dataset.column, select]));
  for (const [name, select] of Object.entries(selects)) {
    select.append(new Option("all", ""));
    for (const value of new Set(data.rows.map(row => row[name]))) select.append(new Option(value, value));
  }
  $.fn.dataTable.ext.search.push((settings, texts, index, row) =>
    names.every(name => !selects[name].value || selects[name].value === row[name]));
  $("#filters").on("change", "select", () => table.draw());
  $("#reset").on("click", () => {
    for (const name of names) selects[name].value = "";
    table.search("").draw();
  });

  // One cell ------------------------------------------------------------------------------------------------------

  /// Intersection over union along the sweep; a filled dot is within the budget.
  function curve(row, scene) {
    const picture = svg("svg", { viewBox: "0 0 640 150", role: "img" });
    const x = place => 60 + 540 * (row.cells.length > 1 ? place / (row.cells.length - 1) : 0.5);
    const y = iou => 115 - 95 * iou;
    for (const level of [0, 0.5, 1]) {
      picture.append(svg("line", { x1: 50, x2: 610, y1: y(level), y2: y(level), stroke: "#e5e7eb" }));
      picture.append(svg("text", { x: 42, y: y(level) + 4, "text-anchor": "end", "font-size": 11 }, String(level)));
    }
    const there = row.cells.map((cell, place) => [place, cell]).filter(([, cell]) => !cell.failure);
    picture.append(svg("polyline", { fill: "none", stroke: "#0072b2",
      points: there.map(([place, cell]) => `${x(place)},${y(cell.all.iou)}`).join(" ") }));
    row.cells.forEach((cell, place) => {
      picture.append(svg("circle", { cx: x(place), cy: y(cell.failure ? 0 : cell.all.iou), r: 4,
        fill: cell.inBudget ? "#0072b2" : "#fff", stroke: cell.inBudget ? "#0072b2" : "#9a3412" }));
      picture.append(svg("text", { x: x(place), y: 134, "text-anchor": "middle", "font-size": 11 },
        String(scene.values[place])));
    });
    picture.append(svg("text", { x: 330, y: 148, "text-anchor": "middle", "font-size": 11 },
      `${scene.parameter} ${scene.unit && `(${scene.unit})`}; up: IoU; filled: within the budget`));
    return picture;
  }

  function pictureOf(row, scene, place) {
    const image = made("img");
    image.src = data.pictures[row.cells[place].picture];
    image.alt = "errors";
    return made("figure", "", image,
      made("figcaption", `at ${valueOf(scene, place)}: missed shadow red, false shadow blue`));
  }

  function stripOf(row, scene) {
    const image = made("img");
    image.src = data.pictures[row.strip];
    image.alt = "flicker";
    return made("figure", "", image, made("figcaption", `moving camera at ${row.filmed} ${scene.unit}`.trim() +
      ": a frame, the next one, and in red what changed beyond the truth"));
  }

  function flickerText(row) {
    if (row.filmed === null) return "";
    return `While the camera moves: flicker ${shown(row.flicker)}, edge crawl ${shown(row.crawl)} px beyond the ` +
      `${shown(row.rayCrawl)} px of one ray a pixel.`;
  }

  function valueLines(row, scene) {
    const head = ["value", "p95 (px)", "wrong (px)", "shadow (px)", "IoU", "wrong on its receiver", "it says"];
    const lines = row.cells.map((cell, place) => [valueOf(scene, place), shown(cell.all.p95), shown(cell.all.wrong),
      shown(cell.all.shadow), shown(cell.all.iou), cell.receiver ? shown(cell.receiver.wrong) : "–",
      cell.failure ? `${cell.failure}: ${cell.message}` : [...cell.diagnosis, ...cell.notes].join(" ")]);
    return [made("tr", "", ...head.map(text => made("th", text))),
      ...lines.map(line => made("tr", "", ...line.map(text => made("td", text))))];
  }

  function openCell(number) {
    const row = data.rows[number];
    if (!row) return;
    const scene = scenes.get(row.scene);
    document.getElementById("cell-title").textContent = `${row.kit} ${labelOf(row)}: ${scene.id}, ${scene.title}`;
    document.getElementById("cell-about").textContent = scene.about;
    document.getElementById("cell-outcome").textContent =
      row.left === null ? "" : `${row.outcome} at ${valueOf(scene, row.left)}`;
    document.getElementById("cell-curve").replaceChildren(curve(row, scene));
    const places = row.cells.map((cell, place) => place).filter(place => row.cells[place].picture !== null);
    document.getElementById("cell-pictures").replaceChildren(...places.map(place => pictureOf(row, scene, place)));
    if (row.strip !== null) document.getElementById("cell-pictures").append(stripOf(row, scene));
    document.getElementById("cell-flicker").textContent = flickerText(row);
    document.getElementById("cell-values").replaceChildren(...valueLines(row, scene));
    if (!dialog.open) dialog.showModal();
    dialog.scrollTop = 0;
  }

  for (const selector of ["#heat", "#table tbody"]) {
    $(selector).on("click", "[data-number]", event => openCell(Number(event.currentTarget.dataset.number)));
    $(selector).on("keydown", "[data-number]", event => {
      if (event.key === "Enter") openCell(Number(event.currentTarget.dataset.number));
    });
  }
  $("#close").on("click", () => dialog.close());
  dialog.addEventListener("click", event => { if (event.target === dialog) dialog.close(); });
});
