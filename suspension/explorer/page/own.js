export function renderOwn() {}
