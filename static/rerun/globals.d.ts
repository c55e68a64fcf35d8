/** What the script of rerun leaves on the page; it comes without types. */
declare const wasm_bindgen: any;
