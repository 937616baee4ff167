/** What was saved goes to the user's own files, too: those of the session belong to the browser. */
import type { KeptFile } from "./messages.js";

interface FileHandle {
  createWritable(): Promise<{ write(bytes: Uint8Array<ArrayBuffer>): Promise<void>; close(): Promise<void> }>;
}

/** Where the browser offers it, a person chooses the file once, and later saves write it again. */
type Picker = (options: { suggestedName: string }) => Promise<FileHandle>;

const handles = new Map<string, FileHandle>();

function pickerOfBrowser(): Picker | null {
  return (window as { showSaveFilePicker?: Picker }).showSaveFilePicker?.bind(window) ?? null;
}

/** A person is asked for one file at most: without a click behind it, browsers refuse a second question. */
export async function saveOwnFiles(files: readonly KeptFile[], pick: Picker | null = pickerOfBrowser(), send = download): Promise<void> {
  let mayAsk = true;
  for (const [path, bytes] of files) {
    if (!path.startsWith("/home/") || !bytes) continue;
    const name = path.slice(path.lastIndexOf("/") + 1);
    try {
      const handle = handles.get(path) ?? (mayAsk && pick ? await pick({ suggestedName: name }) : null);
      if (!handles.has(path)) mayAsk = false;
      if (handle) await write(handle, bytes);
      if (handle) handles.set(path, handle);
      else send(name, bytes);
    } catch (error) {
      // Who closes the dialog wants no file; where there may be no dialog, as in a frame, it is downloaded.
      if (!(error instanceof DOMException && error.name === "AbortError")) send(name, bytes);
      handles.delete(path);
      mayAsk = false;
    }
  }
}

async function write(handle: FileHandle, bytes: Uint8Array<ArrayBuffer>): Promise<void> {
  const file = await handle.createWritable();
  await file.write(bytes);
  await file.close();
}

function download(name: string, bytes: Uint8Array<ArrayBuffer>): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([bytes]));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
