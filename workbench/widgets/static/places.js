// The place of the plane that views speak of: where the mouse is, or where the sample is.

const PLACE = "workbench-place";

/** Tell the other views on the channel a place, [x, y], and in a word why: "hover", "step", … */
function announcePlace(channel, place, reason) {
  document.dispatchEvent(new CustomEvent(PLACE, { detail: { channel, place, reason } }));
}

function onPlace(model, callback, signal) {
  document.addEventListener(
    PLACE,
    ({ detail }) => detail.channel === model.get("channel") && callback(detail.place, detail.reason),
    { signal },
  );
}

/** A number in three digits, for text. */
function brief(value) {
  return Number(value.toPrecision(3)).toString();
}
