// A button on each block of code that copies it: without prompts, as it stands.
for (const block of document.querySelectorAll("div.highlight")) {
  if (block.closest(".highlight-text")) continue;
  const button = document.createElement("button");
  button.type = "button";
  button.className = "copy";
  button.textContent = "copy";
  button.addEventListener("click", async () => {
    const text = block.querySelector("pre").textContent.trimEnd();
    try {
      await navigator.clipboard.writeText(text);
      button.textContent = "copied";
    } catch {
      // Without leave to write, mark the text: Ctrl-C then copies it.
      getSelection().selectAllChildren(block.querySelector("pre"));
      button.textContent = "Ctrl-C";
    }
    setTimeout(() => (button.textContent = "copy"), 1500);
  });
  block.append(button);
}
