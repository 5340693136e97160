// Bring the views of an exported page to life. Each gets a model of its own that needs no
// kernel: it holds the traits and answers what Python would answer.

const page = JSON.parse(document.getElementById("wb-content").textContent);

function bytesOf(text) {
  return new DataView(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
}

class Model {
  constructor({ traits, binary }) {
    this.traits = { ...traits };
    for (const [name, text] of Object.entries(binary)) this.traits[name] = bytesOf(text);
    this.listeners = new Map();
  }

  get(name) {
    return this.traits[name];
  }

  set(name, value) {
    this.traits[name] = value;
    this.tell(`change:${name}`, this, value);
  }

  save_changes() {
    // There is nobody to save for.
  }

  on(event, act) {
    this.listeners.set(event, [...(this.listeners.get(event) ?? []), act]);
  }

  off(event, act) {
    this.listeners.set(event, (this.listeners.get(event) ?? []).filter((each) => act && each !== act));
  }

  tell(event, ...details) {
    for (const act of this.listeners.get(event) ?? []) act(...details);
  }

  send({ want }) {
    if (want in page.answers) this.tell("msg:custom", { kind: want }, [bytesOf(page.answers[want])]);
  }
}

const modules = page.modules.map((text) => {
  const address = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
  return import(address);
});

for (const place of document.querySelectorAll(".wb-place[data-view]")) {
  const view = page.views[place.dataset.view];
  modules[view.module]
    .then((module) => {
      place.replaceChildren();
      return module.default.render({ model: new Model(view), el: place });
    })
    .catch((error) => place.replaceChildren(`This view cannot be shown: ${error.message}`));
}
