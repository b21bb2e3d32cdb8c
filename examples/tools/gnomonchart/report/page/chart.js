// The page of gnomonchart: the scene that the figures show, the table, and the window of one point. All text from the
// results enters the document as text, never as markup.
"use strict";
$(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const scenes = new Map(data.scenes.map(scene => [scene.name, scene]));
  const names = ["scene", "kit", "technique", "setting"];
  const dialog = document.getElementById("point");
  let open = -1; // number of the point that the window shows

  const sceneTitle = name => scenes.has(name) ? scenes.get(name).title : name;
  const pointName = point => `${point.kit} ${point.technique}, ${point.setting}`;

  // The table -----------------------------------------------------------------------------------------------------

  const plain = $.fn.dataTable.render.text(); // escapes markup
  const columns = names.map(name => ({ title: name, data: name, render: plain }));
  columns.push({ title: "catastrophe", data: point => point.bad ? "yes" : "no" });
  data.numbers.forEach((number, i) => {
    if (!number.inTable) return;
    columns.push(measuredColumn(`${number.title}<span class="unit">${number.unit}</span>`, point => point.values[i]));
  });

  const table = $("#table").DataTable({
    data: data.points.map((point, number) => Object.assign(point, { number })),
    columns,
    paging: false,
    order: [],
    orderClasses: false,
    autoWidth: false,
    language: { search: "Search in all columns ", info: "_TOTAL_ points", infoEmpty: "no points",
      infoFiltered: "of _MAX_", zeroRecords: "No point matches.", emptyTable: "Nothing was measured." },
    createdRow: (row, point) => {
      row.tabIndex = 0;
      row.classList.toggle("gnomon", point.kit === "Gnomon");
      row.classList.toggle("bad", point.bad !== "");
      row.dataset.number = point.number;
    }
  });

  // Filters -------------------------------------------------------------------------------------------------------

  const selects = Object.fromEntries($("#filters select").toArray().map(select => [select.dataset.column, select]));

  for (const [name, select] of Object.entries(selects)) {
    select.append(new Option("all", ""));
    for (const value of new Set(data.points.map(point => point[name]))) select.append(new Option(value, value));
  }

  $.fn.dataTable.ext.search.push((settings, texts, index, point) => {
    if (document.getElementById("sound").checked && point.bad) return false;
    return names.every(name => !selects[name].value || selects[name].value === point[name]);
  });

  /// Shows only points that are as told; what is not told may be anything.
  function filter(wanted) {
    for (const name of names) selects[name].value = wanted[name] || "";
    table.draw();
  }

  $("#filters").on("change", "select, input", () => table.draw());
  $("#reset").on("click", () => {
    document.getElementById("sound").checked = false;
    table.search("");
    filter({});
  });

  // One point -----------------------------------------------------------------------------------------------------

  function setPicture(id, number, text) {
    const frame = document.getElementById(id);
    const image = made("img");
    image.alt = text;
    if (number !== null) image.src = data.pictures[number];
    frame.replaceChildren(number === null ? made("span", "no picture") : image);
  }

  function numberTable(group, point) {
    const rows = data.numbers.map((number, i) => ({ number, value: point.values[i] }))
      .filter(row => row.number.group === group)
      .map(row => made("tr", "", made("td", row.number.title),
        made("td", `${shown(row.value)} ${row.value === null ? "" : row.number.unit}`.trim())));
    return made("div", "", made("h3", group), made("table", "", ...rows));
  }

  function pairTable(title, pairs) {
    const rows = pairs.map(([name, value]) => made("tr", "", made("td", name), made("td", value)));
    return made("div", "", made("h3", title), made("table", "", ...rows));
  }

  function scenePairs(scene) {
    return [["triangles", String(scene.triangles)], ["a frame without shadows", `${shown(scene.frame)} ms`],
      ["boundary error of one perfect ray a pixel", `${shown(scene.boundaryFloor)} px`],
      ["pixels that it misclassifies", `${shown(scene.misclassifiedFloor)} %`], ...scene.view];
  }

  function setNumbers(point) {
    const groups = [...new Set(data.numbers.map(number => number.group))].map(group => numberTable(group, point));
    if (point.settings.length) groups.unshift(pairTable("settings", point.settings));
    if (scenes.has(point.scene)) groups.push(pairTable("scene", scenePairs(scenes.get(point.scene))));
    document.getElementById("point-numbers").replaceChildren(...groups);
  }

  function setNotes(notes) {
    const list = made("ul", "", ...notes.map(note => made("li", note)));
    document.getElementById("point-notes").replaceChildren(...(notes.length ? [made("h3", "notes"), list] : []));
  }

  function openPoint(number) {
    const point = data.points[number];
    if (!point) return;
    open = number;
    const scene = scenes.get(point.scene);
    document.getElementById("point-title").textContent = `${pointName(point)}: ${sceneTitle(point.scene)}`;
    document.getElementById("point-bad").textContent = point.bad ? `Catastrophic: ${point.bad}` : "";
    setPicture("point-picture", point.picture, "the picture");
    setPicture("point-truth", scene ? scene.truth : null, "the truth");
    setPicture("point-overlay", point.overlay, "the errors");
    setNumbers(point);
    setNotes(point.notes);
    if (!dialog.open) dialog.showModal();
    dialog.scrollTop = 0;
    history.replaceState(null, "", `#point-${number}`);
  }

  /// Up or down in the table as it is sorted and filtered now.
  function step(way) {
    const shownNow = table.rows({ search: "applied" }).data().toArray().map(point => point.number);
    const next = shownNow[shownNow.indexOf(open) + way];
    if (next !== undefined) openPoint(next);
  }

  $("#table tbody").on("click", "tr", event => openPoint(Number(event.currentTarget.dataset.number)));
  $("#table tbody").on("keydown", "tr", event => {
    if (event.key === "Enter") openPoint(Number(event.currentTarget.dataset.number));
  });
  $("#previous").on("click", () => step(-1));
  $("#next").on("click", () => step(1));
  $("#close").on("click", () => dialog.close());
  dialog.addEventListener("click", event => { if (event.target === dialog) dialog.close(); });
  dialog.addEventListener("close", () => history.replaceState(null, "", location.pathname));

  // The figures ---------------------------------------------------------------------------------------------------

  function showScene(name) {
    for (const figure of document.querySelectorAll("#figures figure")) figure.hidden = figure.dataset.scene !== name;
  }
  $("#scene").on("change", event => showScene(event.currentTarget.value));
  showScene("");

  /// A marker of one scene is a point; one of all scenes is a row in each.
  $("#figures").on("click", ".point", event => {
    const wanted = { ...event.currentTarget.dataset };
    const scene = event.currentTarget.closest("figure").dataset.scene;
    if (scene) {
      openPoint(data.points.findIndex(point => point.scene === scene &&
        ["kit", "technique", "setting"].every(name => point[name] === wanted[name])));
    } else {
      filter(wanted);
      document.getElementById("points").scrollIntoView();
    }
  });

  const asked = /^#point-(\d+)$/.exec(location.hash);
  if (asked) openPoint(Number(asked[1]));
});
