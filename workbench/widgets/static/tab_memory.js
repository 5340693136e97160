// Remember a word for as long as the tab is open. A tab that was duplicated begins with a copy of
// what the first one remembered, and goes its own way from there.

export default {
  render({ model }) {
    const stop = new AbortController();
    const key = () => `workbench:${model.get("name")}`;
    const keep = () => {
      if (!model.get("name")) return;
      if (model.get("word")) sessionStorage.setItem(key(), model.get("word"));
      else sessionStorage.removeItem(key());
    };
    const recall = () => {
      const word = model.get("name") && !model.get("word") ? sessionStorage.getItem(key()) : "";
      if (!word) return;
      model.set("recalled", word);
      model.save_changes();
    };
    onTraits(model, ["word"], keep, stop.signal);
    onTraits(model, ["name"], recall, stop.signal);
    if (model.get("word")) keep();
    else recall();
    return () => stop.abort();
  },
};
