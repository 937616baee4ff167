/** The session's own files, kept here for the next worker and in the browser for the next visit. */
import type { KeptFile } from "./messages.js";

/** Pages of one growth keep what is theirs. */
function nameOfStore(): string {
  return document.documentElement.dataset.open ? `espalier-studio ${location.pathname}` : "espalier-studio";
}

const store = "files";

const files = new Map<string, Uint8Array<ArrayBuffer>>();
let isRead = false;
let database: Promise<IDBDatabase | null> | null = null;

/** None where the browser keeps nothing, as for pages that lie on a disk. */
function open(): Promise<IDBDatabase | null> {
  return new Promise((resolve) => {
    try {
      const request = indexedDB.open(nameOfStore(), 1);
      request.onupgradeneeded = () => request.result.createObjectStore(store);
      request.onsuccess = () => resolve(request.result);
      request.onerror = () => resolve(null);
    } catch {
      resolve(null);
    }
  });
}

async function read(): Promise<void> {
  isRead = true;
  const kept = await (database ??= open());
  if (!kept) return;
  const objects = kept.transaction(store).objectStore(store);
  const [paths, contents] = await Promise.all([result(objects.getAllKeys()), result(objects.getAll())]);
  paths.forEach((path, i) => files.set(String(path), contents[i] as Uint8Array<ArrayBuffer>));
}

function result<T>(request: IDBRequest<T>): Promise<T> {
  return new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

export async function keptFiles(): Promise<KeptFile[]> {
  if (!isRead) await read().catch(() => undefined);
  return [...files];
}

/** The first worker began with these. */
export function haveRead(kept: readonly KeptFile[]): void {
  isRead = true;
  for (const [path, bytes] of kept) if (bytes) files.set(path, bytes);
}

export function keepFiles(changed: KeptFile[]): void {
  for (const [path, bytes] of changed) {
    if (bytes) files.set(path, bytes);
    else files.delete(path);
  }
  void keepInBrowser(changed);
}

async function keepInBrowser(changed: KeptFile[]): Promise<void> {
  const kept = await (database ??= open());
  if (!kept) return;
  const objects = kept.transaction(store, "readwrite").objectStore(store);
  for (const [path, bytes] of changed) {
    if (bytes) objects.put(bytes, path);
    else objects.delete(path);
  }
}
