// Telling Python of edits, one after the other, each with the scene that it was made on.

const ANSWER_WITHIN = 15_000; // milliseconds

class PadPost {
  constructor(pad) {
    // `shown` is the scene in sight, `base` the one that was when the hand took hold: by its
    // revision or, where that is still to come, by the edit whose answer brings it.
    Object.assign(this, { pad, pending: 0, sent: 0, queue: [], base: null });
    this.show();
  }

  get answered() {
    return this.pad.model.get("answered");
  }

  /** Take note that what Python has is shown. */
  show() {
    this.shown = { revision: this.pad.model.get("revision"), awaits: null };
  }

  /** Tell of an edit, as soon as those before are answered. */
  tell(kind, details) {
    const edit = this.pad.model.get("edit");
    this.pending = Math.max(this.pending, this.answered, edit.number ?? 0) + 1;
    const steps = kind === "undo" || kind === "redo";
    this.queue.push({ number: this.pending, kind, ...details, base: steps ? null : this.base ?? this.shown });
    if (!steps) this.base = null;
    // What these make is not in sight before Python shows it.
    if (!steps && details.place !== "best") this.shown = { revision: null, awaits: this.pending };
    if (this.answered >= this.sent) this.sendNext();
  }

  /** Go on if Python has answered. What was done upon an edit that it refused is put back, too. */
  takeAnswer() {
    if (this.answered < this.sent) return;
    const { model, holding, input } = this.pad;
    const upon = [this.shown, this.base, ...this.queue.map(({ base }) => base)].filter((base) => base?.awaits === this.sent);
    if (!model.get("message")) for (const base of upon) Object.assign(base, { revision: model.get("revision"), awaits: null });
    else if (upon.length) {
      this.queue = [];
      this.pending = this.sent;
      this.show();
      if (holding) input.abandon();
    }
    this.sendNext();
  }

  /** Send one edit: a second one before Python has read the first would take its place. */
  sendNext() {
    const { words } = this.pad;
    clearTimeout(this.patience);
    if (this.late) words.say("");
    this.late = false;
    if (!this.queue.length) return;
    const { base, ...edit } = this.queue.shift();
    if (base) edit.revision = base.revision;
    this.sent = edit.number;
    this.pad.save("edit", edit);
    this.patience = setTimeout(() => {
      this.late = true;
      words.say("Python has not answered yet: it is busy or has stopped. What you see is kept until it does.", true);
    }, ANSWER_WITHIN);
  }
}
