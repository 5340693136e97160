// Which positions each panel shows: those of the embedding, those before its optimization, or
// those that follow from moved control points; and what is said about them.

const RAW = "before optimization";

/** The positions that a panel shows, a word on what they are, and the caption's line of values. */
function shownIn(p, { state, mover, stage }) {
  const { specs, points, raw, panels } = state;
  const { detail = "", raw_detail: rawDetail } = specs[p];
  const of = (words) => (detail && words ? `${words}: ${detail}` : detail);
  const placed = mover.placed[p];
  if (placed) return { points: placed, tag: "moved", detail: of(mover.isNew[p] ? "before moving" : "") };
  const earlier = mover.isNew[p] ? "while moved" : "";
  const before = raw && stage === "raw" ? ofPanel(raw, p, panels) : null;
  if (before && anyKnown(before)) {
    return { points: before, tag: RAW, detail: rawDetail ?? of(earlier || "optimized") };
  }
  return { points: ofPanel(points, p, panels), tag: "", detail: of(earlier) };
}

/** What the coloured values are of, if they are not of the positions shown. */
function remarkOnValues(view) {
  if (view.state.colorBy !== "value") return "";
  const tags = view.panels.map((_, p) => shownIn(p, view).tag);
  if (tags.includes(RAW)) return "values of the optimized positions";
  return view.valuesPrecedeMoving ? "values from before moving" : "";
}
