/* Starts ReDoc; a file of its own because the pages allow no inline script. */
window.addEventListener("load", () => {
  Redoc.init("openapi.json", { hideLoading: true, nativeScrollbars: true }, document.getElementById("page"));
});
