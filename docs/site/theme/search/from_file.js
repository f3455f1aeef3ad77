// Lets the search work in pages that are opened as files. A browser then starts
// no worker and fetches no JSON, but it runs scripts: the worker's runs in a
// hidden frame, and the index is one (build.py writes search_index.js). Pages
// from a server use nothing of this.
if (location.protocol === "file:") {
  let give;
  // The theme looks for an index in this variable before it fetches its own.
  var __search = { index: new Promise((resolve) => { give = resolve; }) };
  window.giveSearchIndex = (index) => give(index);
  const index = document.createElement("script");
  index.src = new URL("search_index.js", document.currentScript.src);
  document.head.append(index);

  window.Worker = class extends EventTarget {
    constructor(url) {
      super();
      const frame = document.createElement("iframe");
      frame.hidden = true;
      document.body.append(frame);
      const inside = frame.contentWindow;
      inside.document.open();
      inside.document.write("<body></body>");
      inside.document.close();
      inside.postMessage = (data) =>
        this.dispatchEvent(new MessageEvent("message", { data }));
      const script = inside.document.createElement("script");
      script.src = new URL(url, location.href);
      const ready = new Promise((resolve) => { script.onload = resolve; });
      inside.document.body.append(script);
      this.postMessage = (data) => ready.then(() =>
        inside.dispatchEvent(new inside.MessageEvent("message", { data })));
    }
  };
}
