// Ratings from 1 to 10: a group of radio buttons for each thing that is rated. What was chosen
// counts as stored when Python says so.

const RATINGS = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10];
const RATING_PATIENCE = 15_000; // milliseconds until a rating that is not stored is worth a word
const RATING_LATE = "Your last rating is not stored yet. If this stays, reload the page: you will go on here.";
const RATING_HINT = "Tab goes from motion to motion. The keys 1 to 9, and 0 for 10, give a rating.";

let ratingForms = 0;

class RatingForm {
  constructor(model, root, signal) {
    Object.assign(this, { model, root, signal, chosen: [], id: `wb-rating-${++ratingForms}-${Math.random().toString(36).slice(2)}` });
    this.heading = element("h3", { class: "wb-rating-heading", tabindex: "-1" });
    this.note = element("p", { class: "wb-detail" });
    this.question = element("p", { class: "wb-rating-question", id: `${this.id}-question` });
    this.waiting = element("p", { class: "wb-rating-waiting", role: "status" });
    this.groups = element("div", { class: "wb-rating-groups" });
    this.message = element("div", { class: "wb-rating-message", role: "alert" });
    this.onward = element("button", { type: "button", class: "wb-rating-onward" });
    this.left = element("span", { class: "wb-detail", role: "status" });
    const end = element("div", { class: "wb-bar" }, [this.onward, this.left]);
    root.append(this.heading, this.question, this.waiting, this.groups, this.message, end, this.note, element("p", { class: "wb-hint", text: RATING_HINT }));
    this.onward.addEventListener("click", () => this.goOn(), { signal });
    root.addEventListener("keydown", (event) => this.key(event), { signal });
    onTraits(model, ["letters", "heading", "note", "question", "onward"], () => this.read(true), signal);
    onTraits(model, ["stored", "ready", "waiting"], () => this.show(), signal);
    onTraits(model, ["message"], () => this.refuse(), signal);
    signal.addEventListener("abort", () => clearTimeout(this.late));
    this.read(false);
    // Whoever pressed a button that is gone with its page goes on here.
    requestAnimationFrame(() => (document.activeElement ?? document.body) === document.body && this.heading.focus({ preventScroll: true }));
  }

  /** Take another item. Whoever works with the keyboard is led to its heading. */
  read(moved) {
    const { model } = this;
    this.heading.textContent = model.get("heading");
    this.note.textContent = model.get("note");
    this.question.textContent = model.get("question");
    this.onward.textContent = model.get("onward");
    this.going = false;
    this.chosen = [...model.get("stored")];
    this.groups.replaceChildren(...model.get("letters").map((letter, i) => this.group(letter, i)));
    this.show();
    if (moved) this.heading.focus({ preventScroll: true });
  }

  group(letter, i) {
    const buttons = RATINGS.map((rating) => {
      const input = element("input", { type: "radio", name: `${this.id}-${i}`, value: String(rating), "aria-label": `${rating}` });
      input.addEventListener("change", () => this.choose(i, rating), { signal: this.signal });
      return element("label", {}, [input, element("span", { text: String(rating), "aria-hidden": "true" })]);
    });
    const state = element("span", { class: "wb-rating-state" });
    const scale = element("span", { class: "wb-rating-scale" }, buttons);
    return element("fieldset", { "data-thing": String(i), "aria-describedby": `${this.id}-question` }, [element("legend", { text: letter, "aria-label": `Quality of motion ${letter}, 1 to 10` }), scale, state]);
  }

  choose(i, rating) {
    this.chosen[i] = rating;
    this.model.set("chosen", [...this.chosen]);
    this.model.save_changes();
    this.show();
  }

  goOn() {
    if (this.onward.disabled) return;
    this.going = true;
    this.model.set("finished", this.model.get("finished") + 1);
    this.model.save_changes();
    this.show();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    // JupyterLab would take the key as a command to its cells.
    event.stopPropagation();
    const group = event.target.closest("fieldset");
    if (!group || group.disabled || !/^[0-9]$/.test(event.key)) return;
    event.preventDefault();
    const input = group.querySelector(`input[value="${event.key === "0" ? 10 : event.key}"]`);
    input.focus();
    if (!input.checked) input.click();
  }

  tell(words) {
    this.message.textContent = words;
  }

  /** What Python refused is not shown as chosen. */
  refuse() {
    if (this.model.get("message")) {
      this.chosen = [...this.model.get("stored")];
      this.going = false;
    }
    this.show();
  }

  show() {
    const { model } = this;
    const [stored, ready] = [model.get("stored"), model.get("ready")];
    [...this.groups.children].forEach((group, i) => {
      group.disabled = !ready || this.going;
      for (const input of group.querySelectorAll("input")) input.checked = Number(input.value) === this.chosen[i];
      const there = stored[i] > 0 && stored[i] === this.chosen[i];
      const state = group.querySelector(".wb-rating-state");
      state.textContent = there ? "✓" : this.chosen[i] > 0 ? "…" : "";
      state.title = there ? "stored" : this.chosen[i] > 0 ? "being stored" : "";
    });
    this.waiting.textContent = ready ? "" : model.get("waiting");
    this.tell(model.get("message"));
    const missing = model.get("letters").filter((_, i) => !(stored[i] > 0 && stored[i] === this.chosen[i]));
    // Python may have stopped, which nothing else would tell.
    clearTimeout(this.late);
    if (this.going || this.chosen.some((rating, i) => rating > 0 && rating !== stored[i])) this.late = setTimeout(() => this.tell(RATING_LATE), RATING_PATIENCE);
    this.onward.disabled = !ready || this.going || missing.length > 0;
    this.left.textContent = !ready ? "" : missing.length ? `still to rate: ${missing.join(", ")}` : "✓ all stored";
  }
}

export default {
  render({ model, el }) {
    const stop = new AbortController();
    const root = element("div", { class: "wb wb-rating" });
    el.append(root);
    root.form = new RatingForm(model, root, stop.signal);
    return () => stop.abort();
  },
};
