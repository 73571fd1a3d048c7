// SPDX-License-Identifier: MIT
#include "batch/index_page.h"

namespace vantage::batch {
namespace {

// Names and errors come from strangers' files: the script only ever sets text, never markup, and
// the policy lets nothing in from outside.
constexpr const char* kHead = R"html(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src 'self' file:; script-src 'unsafe-inline'; style-src 'unsafe-inline'">
<title>Vantage: results</title>
<style>
:root { color-scheme: light dark; --line: #8884; --dim: #888; --bad: #c33; }
body { font: 14px/1.45 system-ui, sans-serif; margin: 0; }
header { position: sticky; top: 0; background: Canvas; padding: 12px 16px; border-bottom: 1px solid var(--line);
  display: flex; flex-wrap: wrap; gap: 8px 16px; align-items: center; z-index: 1; }
h1 { font-size: 16px; margin: 0; }
input, select, button { font: inherit; padding: 3px 8px; }
#search { min-width: 16em; }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(176px, 1fr)); gap: 12px; padding: 16px; }
article { border: 1px solid var(--line); border-radius: 6px; padding: 8px; overflow: hidden; }
article a { display: block; }
.picture { height: 128px; display: flex; align-items: center; justify-content: center; color: var(--dim);
  background: #f4f4f4; border-radius: 4px; }
img { max-width: 100%; max-height: 128px; }
.name { font-weight: 600; overflow-wrap: anywhere; max-height: 2.9em; overflow: hidden; margin-top: 6px; }
.note { color: var(--dim); font-size: 12px; overflow-wrap: anywhere; max-height: 7em; overflow: auto; }
.failed .note, .doubt { color: var(--bad); }
.doubt { font-size: 12px; }
nav { margin-left: auto; display: flex; gap: 8px; align-items: center; }
</style>
</head>
<body>
<header>
<h1>Vantage</h1>
<span id="counts"></span>
<input id="search" type="search" placeholder="name, path or error" aria-label="search">
<select id="status" aria-label="status"><option value="">all</option><option>done</option><option>failed</option>
<option>duplicate</option><option value="doubted">doubted answers</option></select>
<select id="sort" aria-label="order"><option value="key">by path</option><option value="name">by name</option>
<option value="low">least seen first</option><option value="high">most seen first</option>
<option value="size">largest first</option></select>
<nav><button id="back">‹</button><span id="place"></span><button id="next">›</button></nav>
</header>
<noscript><p style="padding:16px">This page needs its own script to draw the table; <code>vantage results
query</code> prints the same.</p></noscript>
<main id="models"></main>
<p id="files" style="padding:0 16px"></p>
<script type="application/json" id="data">
)html";

constexpr const char* kScript = R"html(
</script>
<script>
"use strict";
const page = JSON.parse(document.getElementById("data").textContent);
const rows = page.rows.map(r => ({key: r[0], name: r[1], status: r[3] && r[2] === "done" ? "duplicate" : r[2],
  equal: r[3], error: r[4], folder: r[5], fraction: r[6], score: r[7], vertices: r[8], has: r[9]}));
const PER_PAGE = 120;
const by = id => document.getElementById(id);
const text = (tag, kind, words) => {
  const e = document.createElement(tag);
  e.className = kind;
  e.textContent = words;
  return e;
};
// What has no value comes last in every order.
const last = (a, b, sign) => a === null ? (b === null ? 0 : 1) : b === null ? -1 : sign * (a - b);
const twins = new Map();
for (const row of rows) twins.set(row.name, (twins.get(row.name) || 0) + 1);
const order = {
  key: () => 0,
  name: (a, b) => a.name < b.name ? -1 : a.name > b.name ? 1 : 0,
  low: (a, b) => last(a.fraction, b.fraction, 1),
  high: (a, b) => last(a.fraction, b.fraction, -1),
  size: (a, b) => last(a.vertices, b.vertices, -1),
};
let shown = rows, at = 0;

function note(row) {
  if (row.status === "failed") return row.error;
  const parts = twins.get(row.name) > 1 ? [row.key] : [];
  if (row.fraction !== null) parts.push((100 * row.fraction).toFixed(1) + " % of the significance");
  if (row.vertices !== null) parts.push(row.vertices.toLocaleString("en") + " vertices");
  if (row.status === "duplicate") parts.push("same content as " + row.equal);
  return parts.join(" · ");
}

function card(row) {
  const box = text("article", row.status, "");
  box.title = row.key;
  const path = "models/" + row.folder + "/";
  const frame = text(row.has & 6 ? "a" : "div", "picture", row.has & 1 ? "" : row.status === "failed" ? "failed" : "no picture");
  if (row.has & 6) frame.href = path + (row.has & 4 ? "report.html" : "best.png");
  if (row.has & 1) {
    const image = document.createElement("img");
    image.loading = "lazy";
    image.alt = row.name;
    image.src = path + "thumb.png";
    frame.append(image);
  }
  box.append(frame, text("div", "name", row.name), text("div", "note", note(row)));
  if (row.has & 8) box.append(text("div", "doubt", "not to be trusted: its view.json says why"));
  return box;
}

function draw() {
  const pages = Math.max(1, Math.ceil(shown.length / PER_PAGE));
  at = Math.min(Math.max(at, 0), pages - 1);
  by("models").replaceChildren(...shown.slice(at * PER_PAGE, (at + 1) * PER_PAGE).map(card));
  by("place").textContent = shown.length.toLocaleString("en") + " models, page " + (at + 1) + " of " + pages;
  by("back").disabled = at === 0;
  by("next").disabled = at === pages - 1;
}

function choose() {
  const words = by("search").value.toLowerCase();
  const status = by("status").value;
  shown = rows.filter(r => (!status || r.status === status || (status === "doubted" && r.has & 8)) &&
    (!words || (r.name + "\n" + r.key + "\n" + r.error).toLowerCase().includes(words)));
  if (by("sort").value !== "key") shown.sort(order[by("sort").value]);
  at = 0;
  draw();
}

by("search").addEventListener("input", choose);
by("status").addEventListener("change", choose);
by("sort").addEventListener("change", choose);
by("back").addEventListener("click", () => { --at; draw(); scrollTo(0, 0); });
by("next").addEventListener("click", () => { ++at; draw(); scrollTo(0, 0); });
by("counts").textContent = page.done.toLocaleString("en") + " done, " + page.failed.toLocaleString("en") +
  " failed, " + page.duplicates.toLocaleString("en") + (page.duplicates === 1 ? " duplicate" : " duplicates");
if (page.pages.length > 1) {
  by("files").append("Further models: ");
  page.pages.forEach((name, i) => {
    const link = text("a", "", String(i + 1));
    if (i !== page.page) link.href = name;
    by("files").append(link, " ");
  });
}
draw();
</script>
</body>
</html>
)html";

}  // namespace

std::string script_safe(const std::string& json) {
  std::string text;
  for (const char c : json) {
    text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  }
  return text;
}

std::string url_path(std::string_view path) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~/";
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string text;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    text += kPlain.find(c) != std::string_view::npos
                ? std::string(1, c)
                : std::string{'%', kDigits[byte >> 4U], kDigits[byte & 15U]};
  }
  return text;
}

std::string index_page(const std::string& rows, const std::vector<std::string>& pages,
                       std::size_t page, const StatusCounts& counts) {
  std::string names;
  for (const std::string& name : pages) {
    names += (names.empty() ? "\"" : ",\"") + name + '"';
  }
  return kHead + ("{\"done\":" + std::to_string(counts.done)) +
         ",\"failed\":" + std::to_string(counts.failed) +
         ",\"duplicates\":" + std::to_string(counts.duplicates) +
         ",\"page\":" + std::to_string(page) + ",\"pages\":[" + names + "],\"rows\":[\n" + rows +
         "]}" + kScript;
}

}  // namespace vantage::batch
