// Events of the page: every change becomes one entry of the store "event", one after the other.
(() => {
  "use strict";
  const token = location.pathname.split("/")[1];
  // A page of another run on the same port begins afresh.
  if (sessionStorage.getItem("workbench-run") !== token) {
    sessionStorage.clear();
    sessionStorage.setItem("workbench-run", token);
  }
  let session = sessionStorage.getItem("workbench-session");
  if (!session) {
    session = [...crypto.getRandomValues(new Uint8Array(16))].map((b) => b.toString(16).padStart(2, "0")).join("");
    sessionStorage.setItem("workbench-session", session);
  }
  const set = (id, props) => window.dash_clientside.set_props(id, props);
  const queue = [];
  let number = 0, busy = false, since = 0;
  // The timer of a slider that has moved and whose value is not sent yet; 0 without one.
  let dragging = 0;

  // Changes wait for the answer to the one before, so that none is lost. A newer value of one field
  // takes the place of an older one.
  function send(event) {
    const same = queue.findIndex((e) => e.event === "value" && event.event === "value" && e.key === event.key);
    if (same >= 0) queue.splice(same, 1);
    queue.push(event);
    next();
  }
  function next() {
    if ((busy && Date.now() - since < 20000) || !queue.length) return;
    busy = true;
    since = Date.now();
    number += 1;
    set("event", { data: { ...queue.shift(), number, session } });
  }
  window.dash_clientside = window.dash_clientside || {};
  window.workbench = {
    send,
    done: () => { busy = false; setTimeout(next, 0); },
    idle: () => !busy && !queue.length && !dragging,
    session,
  };

  function place(input) { return input.closest(".field.number"); }
  function toValue(box, step) {
    const low = Number(box.dataset.low), high = Number(box.dataset.high);
    return Number((10 ** (low + ((high - low) * step) / 240)).toPrecision(3));
  }
  function toStep(box, value) {
    const low = Number(box.dataset.low), high = Number(box.dataset.high);
    return Math.max(0, Math.min(240, Math.round((240 * (Math.log10(value) - low)) / (high - low))));
  }
  document.addEventListener("input", (e) => {
    if (e.target.type !== "range" || !place(e.target)) return;
    const box = place(e.target), field = box.querySelector("input[type=number]");
    const value = toValue(box, Number(e.target.value));
    set(field.id, { value });
    clearTimeout(dragging);
    dragging = setTimeout(() => {
      dragging = 0;
      send({ event: "value", key: box.dataset.field, value: String(value) });
    }, 60);
  });
  document.addEventListener("change", (e) => {
    const t = e.target;
    if (t.matches("input[type=number]") && place(t)) {
      const box = place(t), slider = box.querySelector("input[type=range]");
      if (slider && Number(t.value) > 0) set(slider.id, { value: toStep(box, Number(t.value)) });
      send({ event: "value", key: box.dataset.field, value: t.value });
    } else if (t.matches("select[data-event]")) {
      send({ ...t.dataset, value: t.value });
    } else if (t.id === "file-input") {
      upload([...t.files].map((file) => ({ file, path: file.name })));
      t.value = "";
    }
  });
  function formValues() {
    const values = {};
    for (const x of document.querySelectorAll("#panel-answers input[id], #panel-answers select[id], #panel-files input[id], #panel-files select[id]")) values[x.id] = x.value;
    return values;
  }
  document.addEventListener("click", (e) => {
    const tab = e.target.closest("[data-tab][role=tab]");
    if (tab) return show(tab.dataset.tab);
    if (e.target.closest("[data-theme-button]")) return toggleTheme();
    const b = e.target.closest("button[data-event]");
    if (!b) return;
    if (b.dataset.event === "show") return show(b.dataset.name);
    send({ ...b.dataset, values: formValues() });
  });
  document.addEventListener("keydown", (e) => {
    const tab = e.target.closest && e.target.closest("[role=tab]");
    if (!tab || !["ArrowLeft", "ArrowRight"].includes(e.key)) return;
    const tabs = [...document.querySelectorAll("[role=tab]")];
    const to = tabs[(tabs.indexOf(tab) + (e.key === "ArrowRight" ? 1 : -1) + tabs.length) % tabs.length];
    to.focus();
    show(to.dataset.tab);
  });
  function show(name) {
    const main = document.getElementById("main");
    if (!main) return;
    main.dataset.tab = name;
    for (const tab of document.querySelectorAll("[role=tab]")) tab.setAttribute("aria-selected", String(tab.dataset.tab === name));
    sessionStorage.setItem("workbench-tab", name);
    set("tab", { data: name });
    window.dispatchEvent(new Event("resize"));
  }
  function dark() {
    const chosen = document.documentElement.dataset.theme;
    return chosen ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  }
  function labelTheme() {
    const b = document.getElementById("theme");
    if (b) b.textContent = dark() ? "Light" : "Dark";
  }
  function toggleTheme() {
    document.documentElement.dataset.theme = dark() ? "light" : "dark";
    sessionStorage.setItem("workbench-theme", document.documentElement.dataset.theme);
    labelTheme();
  }
  const theme = sessionStorage.getItem("workbench-theme");
  if (theme) document.documentElement.dataset.theme = theme;

  // Files: one request for each, straight from the disk.
  const LIMIT = 200e6;
  async function upload(items) {
    const state = document.getElementById("upload-state");
    const bytes = items.reduce((sum, i) => sum + i.file.size, 0);
    if (bytes > LIMIT) {
      set("upload-state", { children: `Refused: ${(bytes / 1e6).toFixed(0)} MB. A drop may have ${LIMIT / 1e6} MB: cut the file, or read it with fret info and Python.` });
      return;
    }
    const drops = new Map();
    for (const { file, path } of items) {
      const top = path.split("/")[0];
      if (!drops.has(top)) drops.set(top, [...crypto.getRandomValues(new Uint8Array(8))].map((b) => b.toString(16).padStart(2, "0")).join(""));
      set("upload-state", { children: `Reading ${path} ...` });
      const query = new URLSearchParams({ path });
      const answer = await fetch(`/${token}/upload/${session}/${drops.get(top)}?${query}`, { method: "POST", body: file });
      if (!answer.ok) {
        set("upload-state", { children: `Refused: ${await answer.text()}` });
        return;
      }
    }
    set("upload-state", { children: "" });
    for (const [name, id] of drops) send({ event: "dropped", id, name });
  }
  async function walk(entry, prefix, items) {
    if (entry.isFile) items.push({ file: await new Promise((ok, bad) => entry.file(ok, bad)), path: prefix + entry.name });
    else {
      const reader = entry.createReader();
      for (;;) {
        const part = await new Promise((ok, bad) => reader.readEntries(ok, bad));
        if (!part.length) break;
        for (const child of part) await walk(child, `${prefix}${entry.name}/`, items);
      }
    }
  }
  for (const kind of ["dragover", "dragleave", "drop"]) {
    document.addEventListener(kind, async (e) => {
      e.preventDefault();
      const zone = document.getElementById("drop");
      if (zone) zone.classList.toggle("over", kind === "dragover");
      if (kind !== "drop") return;
      const items = [];
      const entries = [...e.dataTransfer.items].map((i) => i.webkitGetAsEntry && i.webkitGetAsEntry()).filter(Boolean);
      show("files");
      for (const entry of entries) await walk(entry, "", items);
      if (items.length) upload(items);
    });
  }
  function begin() {
    if (!document.getElementById("main") || !window.dash_clientside.set_props) return setTimeout(begin, 30);
    set("session", { data: session });
    labelTheme();
    const tab = sessionStorage.getItem("workbench-tab");
    if (tab) show(tab);
    const place = document.getElementById("choose-place");
    if (place && !document.getElementById("file-input")) {
      const input = Object.assign(document.createElement("input"), { type: "file", id: "file-input", multiple: true });
      input.setAttribute("aria-label", "Files to read");
      place.append(input);
    }
    if (location.hash.startsWith("#scene=")) send({ event: "link", value: location.hash.slice(7) });
  }
  begin();
})();
