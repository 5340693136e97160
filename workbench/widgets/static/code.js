// Code with a button that copies it. Where the browser does not let a page write to the
// clipboard, the code is selected, so that a key does the same.

function selectAll(place) {
  const range = document.createRange();
  range.selectNodeContents(place);
  const selection = getSelection();
  selection.removeAllRanges();
  selection.addRange(range);
}

export default {
  render({ model, el }) {
    const stop = new AbortController();
    const code = element("pre", { class: "wb-code-text", tabindex: "0", role: "region", "aria-label": "Code of this view" });
    const button = element("button", { type: "button", text: "Copy" });
    const told = element("span", { role: "status", class: "wb-detail" });
    el.append(element("div", { class: "wb wb-code" }, [element("div", { class: "wb-bar" }, [button, told]), code]));

    const show = () => {
      code.textContent = model.get("code");
      told.textContent = "";
    };
    button.addEventListener("click", async () => {
      try {
        await navigator.clipboard.writeText(model.get("code"));
        told.textContent = "copied";
      } catch {
        selectAll(code);
        told.textContent = "selected: press Ctrl+C to copy";
      }
    });
    onTraits(model, ["code"], show, stop.signal);
    show();
    return () => stop.abort();
  },
};
