/** The key of a studio, which stands in its address as #token=KEY. */

/** The key that an address has, or that is given alone; "" if there is none. */
export function keyIn(text: string): string {
  const found = /[#&]token=([0-9a-f]+)/i.exec(text) ?? /^\s*([0-9a-f]{32})\s*$/i.exec(text);
  return found?.[1] ?? "";
}

/** Frames of other pages may keep nothing. */
export function keepKey(key: string): void {
  try {
    sessionStorage.setItem("espalier.token", key);
  } catch {
    // A reload asks for it again.
  }
}

function keptKey(): string {
  try {
    return sessionStorage.getItem("espalier.token") ?? "";
  } catch {
    return "";
  }
}

/** That of the page's address stays for a reload after the fragment has been used. */
export function takeKey(): string {
  const key = keyIn(location.hash);
  if (key) keepKey(key);
  return key || keptKey();
}
