/* Starts Swagger UI; a file of its own because the pages allow no inline script. */
const wordsOf = (entry) =>
  [entry.get("path"), entry.getIn(["operation", "summary"]), entry.getIn(["operation", "description"])]
    .join(" ")
    .toLowerCase();

/* Swagger UI's own filter knows the tags alone: here each word must be in an operation's path, summary or description,
   or in its tag. */
const opsFilter = (groups, phrase) => {
  const words = phrase.toLowerCase().split(/\s+/).filter(Boolean);
  const has = (text) => words.every((word) => text.includes(word));
  return groups
    .map((group, tag) =>
      group.update("operations", (operations) =>
        operations.filter((entry) => has(`${tag.toLowerCase()} ${wordsOf(entry)}`))))
    .filter((group) => group.get("operations").size > 0);
};

const FilterContainer = (_, { React, layoutSelectors, layoutActions }) => () => {
  const filter = layoutSelectors.currentFilter();
  return React.createElement("div", { className: "filter wrapper" },
    React.createElement("input", {
      type: "search",
      className: "operation-filter-input",
      "aria-label": "Find an operation",
      placeholder: "Find an operation by words of its path, name or description",
      value: typeof filter === "string" ? filter : "",
      onChange: (event) => layoutActions.updateFilter(event.target.value || true),
    }));
};

/* Where an operation with a key can do without one, no key is set: no padlock. */
const withKeys = (Original, { React, specSelectors }) => (props) => {
  const needsNone = specSelectors.operations().some((entry) =>
    entry.getIn(["operation", "security"])?.some((way) => way.size === 0));
  return needsNone ? null : React.createElement(Original, props);
};

window.addEventListener("load", () => {
  SwaggerUIBundle({
    url: "openapi.json",
    dom_id: "#page",
    deepLinking: true,
    filter: true,
    tryItOutEnabled: true,
    displayRequestDuration: true,
    validatorUrl: null,
    presets: [SwaggerUIBundle.presets.apis],
    plugins: [{
      fn: { opsFilter },
      wrapComponents: { FilterContainer, AuthorizeBtnContainer: withKeys, authorizeOperationBtn: withKeys },
    }],
  });
});
