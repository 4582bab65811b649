// ---- work.js: what was asked for and is still on its way; shared by all pages.
// While there is any, the page says so by data-busy, for whoever waits for it: a program that takes pictures, a test.

const work = { pending: 0 };

async function busyWith(promise) {
  work.pending += 1;
  document.documentElement.dataset.busy = "true";
  try {
    return await promise;
  } finally {
    work.pending -= 1;
    if (!work.pending) delete document.documentElement.dataset.busy;
  }
}
