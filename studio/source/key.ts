/** The key of a studio, which stands in its address as #token=KEY. */

/** The key that an address has, or that is given alone; "" if there is none. */
export function keyIn(text: string): string {
  const found = /[#&]token=([0-9a-f]+)/i.exec(text) ?? /^\s*([0-9a-f]{32})\s*$/i.exec(text);
  return found?.[1] ?? "";
}

export function keepKey(key: string): void {
  sessionStorage.setItem("espalier.token", key);
}

/** That of the page's address stays for a reload after the fragment has been used. */
export function takeKey(): string {
  const key = keyIn(location.hash);
  if (key) keepKey(key);
  return key || (sessionStorage.getItem("espalier.token") ?? "");
}
