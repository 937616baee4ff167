#!/bin/sh
# Chromium 156 (Debian 12 security), films of H.264 of 720 lines or more whose stream names its matrix, smpte170m, but neither
# primaries nor transfer ("unspecified", as encoders leave them; ITU-T H.264 E.2.1 lets each of the three be said alone).
# Expected: the matrix that is named is used, as for VP9: a picture of rgb(84, 108, 48) is played as that.
# Seen: BT.709 is used, and 108 becomes 103. If primaries and transfer are named, too, the matrix is heeded.
# Prints what was seen; fails if that changes. Installs chromium and ffmpeg (as root) where they are missing.
set -eu
command -v chromium >/dev/null || apt-get install -y --no-install-recommends chromium >/dev/null
command -v ffmpeg >/dev/null || apt-get install -y --no-install-recommends ffmpeg >/dev/null
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
film() {
    name=$1
    shift
    ffmpeg -loglevel error -f lavfi -i color=0x546C30:size=1280x960:rate=10:duration=0.5,format=rgb24 \
        -vf scale=out_color_matrix=smpte170m:out_range=tv,format=yuv420p -color_range tv -colorspace smpte170m "$@" "$name"
}
srgb="-color_primaries bt709 -color_trc iec61966-2-1"
film alone.mp4 -c:v libx264
film whole.mp4 -c:v libx264 $srgb
film alone.webm -c:v libvpx-vp9
cat >play.py <<'END'
import http.server, subprocess, sys, tempfile, threading

PAGE = b"""<script>(async () => {
  const said = [];
  for (const name of ["alone.mp4", "whole.mp4", "alone.webm"]) {
    const video = Object.assign(document.createElement("video"), { muted: true, src: name });
    await new Promise((done) => (video.onloadeddata = done));
    await new Promise((done) => setTimeout(done, 500));
    const canvas = new OffscreenCanvas(1280, 960).getContext("2d");
    canvas.drawImage(video, 0, 0);
    said.push(name + " " + canvas.getImageData(640, 480, 1, 1).data[1]);
  }
  await fetch("/seen", { method: "POST", body: said.join("\\n") + "\\n" });
})();</script>"""
ended = threading.Event()

class Page(http.server.SimpleHTTPRequestHandler):
    def do_GET(self):
        if self.path != "/":
            return super().do_GET()
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(PAGE)
    def do_POST(self):
        sys.stdout.write(self.rfile.read(int(self.headers["Content-Length"])).decode())
        self.send_response(204)
        self.end_headers()
        ended.set()
    def log_message(self, *_):
        pass

server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Page)
threading.Thread(target=server.serve_forever, daemon=True).start()
with tempfile.TemporaryDirectory() as profile:
    browser = subprocess.Popen(["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--user-data-dir=" + profile,
                                "http://127.0.0.1:%d/" % server.server_port], stderr=subprocess.DEVNULL)
    ended.wait(120)
    browser.terminate()
    browser.wait()
END
python3 play.py | tee seen
chromium --version 2>/dev/null
grep -q '^alone.mp4 103$' seen && grep -Eq '^whole.mp4 10[789]$' seen && grep -Eq '^alone.webm 10[789]$' seen
