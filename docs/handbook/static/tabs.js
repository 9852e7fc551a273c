// Whoever chooses curl in one tab gets it in all, here and on the next page.
const tabs = document.querySelectorAll("div.tabs > input");

function choose(language) {
  for (const tab of tabs) tab.checked = tab.value === language;
}

choose(localStorage.getItem("calls") ?? "python");
for (const tab of tabs) {
  tab.addEventListener("change", () => {
    const before = tab.parentElement.getBoundingClientRect().top;
    choose(tab.value);
    localStorage.setItem("calls", tab.value);
    scrollBy(0, tab.parentElement.getBoundingClientRect().top - before);
  });
}
