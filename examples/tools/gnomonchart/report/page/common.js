// What the pages of gnomonchart share. All text from the results enters the document as text, never as markup.
"use strict";

/// Three digits; a dash for what does not exist.
function shown(value) {
  if (value === null || value === undefined) return "–";
  if (typeof value !== "number") return value;
  if (value !== 0 && Math.abs(value) < 0.001) return value.toExponential(1);
  return Math.abs(value) >= 1000 ? String(Math.round(value)) : String(Number(value.toPrecision(3)));
}

function made(name, text = "", ...children) {
  const element = document.createElement(name);
  element.textContent = text;
  element.append(...children);
  return element;
}

/// What does not exist stays last, whichever way a table is sorted.
function compared(a, b, way) {
  const [first, second] = [a, b].map(value => typeof value === "number" ? value : null);
  if (first === null || second === null) return (first === null) - (second === null);
  return way * (first - second);
}
$.fn.dataTable.ext.type.order["measured-asc"] = (a, b) => compared(a, b, 1);
$.fn.dataTable.ext.type.order["measured-desc"] = (a, b) => compared(a, b, -1);

/// A column of numbers. @param title  markup of the program's own. @param data  a row's number, or null.
function measuredColumn(title, data) {
  return { title, className: "number", type: "measured", data,
    render: (value, purpose) => purpose === "display" ? $("<i>").text(shown(value)).html() : value };
}
