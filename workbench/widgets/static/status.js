// A line of text that a screen reader speaks when it changes. The element stays: one that came
// with its text would not be spoken.

export default {
  render({ model, el }) {
    const stop = new AbortController();
    const line = element("div", { class: "wb wb-status", role: "status" });
    el.append(line);
    const show = () => (line.textContent = model.get("value"));
    onTraits(model, ["value"], show, stop.signal);
    show();
    return () => stop.abort();
  },
};
