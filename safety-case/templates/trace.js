"use strict";
(() => {
  const words = document.getElementById("words");
  const status = document.getElementById("status");
  const count = document.getElementById("count");
  const rows = [...document.getElementById("rows").rows].map((row) => ({ row, text: row.textContent.toLowerCase() }));
  const kinds = {
    "": () => true,
    covered: (row) => row.className === "",
    orphan: (row) => row.classList.contains("orphan"),
    review: (row) => row.classList.contains("review"),
    awaits: (row) => row.dataset.awaits === "true",
    bygroup: (row) => {
      const code = row.cells[1];
      return code.querySelector(".group") !== null;
    },
  };
  function filter() {
    const wanted = words.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const { row, text } of rows) {
      row.hidden = !(kinds[status.value](row) && wanted.every((word) => text.includes(word)));
      shown += row.hidden ? 0 : 1;
    }
    count.textContent = `${shown} of ${rows.length}`;
  }
  words.addEventListener("input", filter);
  status.addEventListener("change", filter);
  // The hash is an id: a link to one requirement, and what the filter starts with.
  words.value = decodeURIComponent(location.hash.slice(1));
  filter();
})();
