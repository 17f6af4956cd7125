// SPDX-License-Identifier: GPL-3.0-or-later
// Sliders between two pictures, tables that sort, light and dark. The page can be read without it.
"use strict";

// A slider: `cut` is the border's place in percent of the width; left of it the left picture is seen.
function slider(compare) {
  const stage = compare.querySelector(".stage");
  if (!stage) return;
  const handle = stage.querySelector(".handle");
  const shots = [...compare.querySelectorAll(".shot")];
  const names = { left: "", right: "" };
  let cut = 50;

  function move(to) {
    cut = Math.min(100, Math.max(0, to));
    stage.style.setProperty("--cut", `${cut}%`);
    handle.setAttribute("aria-valuenow", String(Math.round(cut)));
    handle.setAttribute("aria-valuetext", `${Math.round(cut)} % ${names.left}, ${Math.round(100 - cut)} % ${names.right}`);
  }

  function choose(side, index) {
    const shot = shots[index];
    const name = shot.querySelector("figcaption b").textContent;
    const picture = stage.querySelector(`img.${side}`);
    picture.src = shot.querySelector(".whole").src;
    picture.alt = `${side}: ${name}`;
    stage.querySelector(`.tag.${side}`).textContent = name;
    names[side] = name;
    const said = compare.querySelector(`.side.${side} .said`);
    said.replaceChildren(...["dl", ".how"].map((part) => shot.querySelector(part).cloneNode(true)));
    shots.forEach((one, i) => one.classList.toggle(`is-${side}`, i === index));
    move(cut);
  }

  for (const select of compare.querySelectorAll("select")) {
    select.addEventListener("change", () => choose(select.dataset.side, select.selectedIndex));
    choose(select.dataset.side, select.selectedIndex);
  }

  const fromEvent = (event) => {
    const box = stage.getBoundingClientRect();
    move((100 * (event.clientX - box.left)) / box.width);
  };
  stage.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    stage.setPointerCapture(event.pointerId);
    stage.classList.add("dragged");
    handle.focus({ preventScroll: true });
    fromEvent(event);
    event.preventDefault();
  });
  stage.addEventListener("pointermove", (event) => {
    if (stage.hasPointerCapture(event.pointerId)) fromEvent(event);
  });
  for (const end of ["pointerup", "pointercancel"]) stage.addEventListener(end, () => stage.classList.remove("dragged"));

  handle.addEventListener("keydown", (event) => {
    const step = event.shiftKey ? 10 : 2;
    const to = {
      ArrowLeft: cut - step, ArrowDown: cut - step, ArrowRight: cut + step, ArrowUp: cut + step,
      PageDown: cut - 10, PageUp: cut + 10, Home: 0, End: 100,
    }[event.key];
    if (to === undefined) return;
    move(to);
    event.preventDefault();
  });
}

// Sorts by a column: numbers by value, text by letters, both ways; cells without a figure stay at the end.
function sortable(table) {
  const body = table.tBodies[0];
  [...table.tHead.rows[0].cells].forEach((head, column) => {
    head.querySelector("button").addEventListener("click", () => {
      const way = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
      for (const other of head.parentNode.cells) other.setAttribute("aria-sort", "none");
      head.setAttribute("aria-sort", way > 0 ? "ascending" : "descending");
      const numbers = head.classList.contains("number");
      const key = (row) => {
        const cell = row.cells[column];
        if (!numbers) return cell.textContent;
        return cell.dataset.value ? Number(cell.dataset.value) : null;
      };
      const rows = [...body.rows].map((row) => ({ row, value: key(row) }));
      rows.sort((a, b) => {
        if (a.value === null || b.value === null) return (a.value === null) - (b.value === null);
        return way * (numbers ? a.value - b.value : a.value.localeCompare(b.value, "en", { numeric: true }));
      });
      body.append(...rows.map((one) => one.row));
    });
  });
}

// Scenes, and comparisons of a scene, as tabs: one is seen at a time; the address may name it.
function tabs(list) {
  const links = [...list.querySelectorAll("a")];
  const panels = links.map((link) => document.getElementById(link.hash.slice(1)));
  list.setAttribute("role", "tablist");
  list.setAttribute("aria-label", list.dataset.label);

  function show(index) {
    links.forEach((link, i) => {
      link.setAttribute("aria-selected", String(i === index));
      link.tabIndex = i === index ? 0 : -1;
      panels[i].classList.toggle("away", i !== index);
    });
  }

  links.forEach((link, i) => {
    link.setAttribute("role", "tab");
    link.setAttribute("aria-controls", panels[i].id);
    panels[i].setAttribute("role", "tabpanel");
    link.addEventListener("click", (event) => {
      event.preventDefault();
      show(i);
    });
    link.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      const to = event.key === " " ? i : (i + step + links.length) % links.length;
      if (Number.isNaN(to)) return;
      event.preventDefault();
      show(to);
      links[to].focus();
    });
  });
  show(Math.max(0, links.findIndex((link) => link.hash === location.hash)));
}

function theme(button) {
  const root = document.documentElement;
  const dark = () => root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  const tell = () => button.setAttribute("aria-pressed", String(dark()));
  button.addEventListener("click", () => {
    root.dataset.theme = dark() ? "light" : "dark";
    tell();
  });
  tell();
}

document.documentElement.classList.add("js");
document.querySelectorAll(".compare").forEach(slider);
document.querySelectorAll("table.sortable").forEach(sortable);
document.querySelectorAll("button.theme").forEach(theme);
document.querySelectorAll(".tabs").forEach(tabs);
