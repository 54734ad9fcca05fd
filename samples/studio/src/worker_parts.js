// The library in two files: hf.wasm holds what poses and fields call, rest.wasm the other functions (../split.mjs).

/** Loads hf.wasm of a folder: { make, rest }. make goes to the glue of emscripten, rest() loads the other file. */
export async function inTwo(folder) {
  const at = (name) => new URL(name, folder);
  // Streams are compiled while they come, and a browser keeps the code for the next start. A host that sends the file as
  // something else gives bytes.
  const compiled = async (name) => {
    const answer = await fetch(at(name));
    if (!answer.ok) throw new Error(`${name} could not be loaded (${answer.status}).`);
    return answer.headers.get('content-type') === 'application/wasm'
      ? WebAssembly.compileStreaming(answer)
      : WebAssembly.compile(await answer.arrayBuffer());
  };
  const first = await compiled('hf.wasm');
  const whole = !WebAssembly.Module.imports(first).some(({ module }) => module === 'placeholder');
  let primary = null;
  let filled = whole;
  let coming = null;
  const missed = []; // functions that the Worker had to wait for
  // the rest writes its functions into the table of the first, over the calls to JavaScript
  const fill = (module) => {
    if (!filled) new WebAssembly.Instance(module, { primary });
    filled = true;
  };
  // A function that nobody thought of: the Worker waits for the rest.
  const fillNow = () => {
    const request = new XMLHttpRequest();
    request.open('GET', at('rest.wasm'), false);
    request.responseType = 'arraybuffer';
    request.send();
    fill(new WebAssembly.Module(request.response));
  };
  const placeholder = new Proxy(
    {},
    {
      get:
        (_, index) =>
        (...given) => {
          if (!filled) {
            missed.push(index);
            fillNow();
          }
          const table = Object.values(primary).find((thing) => thing instanceof WebAssembly.Table);
          return table.get(Number(index))(...given);
        },
    },
  );
  return {
    missed,
    make: (createHf) =>
      createHf({
        instantiateWasm(imports, done) {
          const instance = new WebAssembly.Instance(first, { ...imports, placeholder });
          primary = instance.exports;
          done(instance);
          return primary;
        },
      }),
    rest() {
      if (filled) return Promise.resolve();
      coming ??= compiled('rest.wasm')
        .then(fill)
        .catch(() => {
          coming = null; // the next call tries again
          throw new Error('This part of the library could not be loaded. Try again when the network is there.');
        });
      return coming;
    },
  };
}
