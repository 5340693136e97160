// The authoring pad: plane, pose and time of spatial keyframes.

export default {
  render({ el }) {
    el.append(element("div", { class: "wb wb-pad" }));
  },
};
