// Gives the handles of ipywidgets' sliders the words beside them as their names.

function nameHandles(box) {
  for (const slider of box.querySelectorAll(".widget-slider")) {
    const words = slider.querySelector(".widget-label")?.textContent ?? "";
    for (const handle of slider.querySelectorAll(".noUi-handle")) {
      // Set only when it differs: setting it is a change that is heard here again.
      if (words && handle.getAttribute("aria-label") !== words) handle.setAttribute("aria-label", words);
    }
  }
}

export default {
  render({ el }) {
    const watch = (box) => observer.observe(box, { childList: true, subtree: true, characterData: true });
    const observer = new MutationObserver(() => {
      if (!found && el.isConnected) settle();
      nameHandles(found ?? document.body);
    });
    let found = null;
    /** Watch no more than the box that this is in, once it is in one. */
    const settle = () => {
      found = el.closest(".widget-vbox") ?? document.body;
      observer.disconnect();
      watch(found);
      nameHandles(found);
    };
    watch(document.body);
    if (el.isConnected) settle();
    return () => observer.disconnect();
  },
};
