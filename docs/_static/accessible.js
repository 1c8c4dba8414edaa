// Levels of headings and names of landmarks, which the theme leaves out.
document.addEventListener("DOMContentLoaded", () => {
  document.querySelectorAll("p.caption[role=heading]:not([aria-level])").forEach((heading) => {
    heading.setAttribute("aria-level", "2");
  });
  // Code and tables that are wider than the page scroll, by keys too.
  document.querySelectorAll("pre, .table-wrapper").forEach((part) => part.setAttribute("tabindex", "0"));
  const names = { "sidebar-drawer": "Site", "toc-drawer": "On this page" };
  for (const [kind, name] of Object.entries(names)) {
    document.querySelectorAll(`aside.${kind}`).forEach((aside) => aside.setAttribute("aria-label", name));
  }
});
