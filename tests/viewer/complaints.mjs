// What a page must not do while a test visits it.

/** What the page's console says from now on, as warnings or errors, and what it asks of a network: a list that grows. */
export function complaints(page) {
  const said = [];
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) said.push(message.text());
  });
  page.on('pageerror', (error) => said.push(error.stack));
  page.on('request', (request) => {
    if (!/^(file|data|blob):/.test(request.url())) said.push(request.url());
  });
  return said;
}
