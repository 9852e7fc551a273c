"""Debian's nginx in front of a service, by the very file that is in `deploy`: only places are put into it."""

import os
import shutil
import ssl
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import urlsplit

from tests.test_serve import HOST, free_port

CONFIGURATION = Path("deploy/nginx/gelenk.conf")
NAME = "lab.example.org"
_AROUND = """
daemon off;
pid {folder}/nginx.pid;
error_log {folder}/error.log;
{user}
events {{}}
http {{
    access_log {folder}/access.log;
    client_body_temp_path {folder}/body;
    proxy_temp_path {folder}/proxy;
    fastcgi_temp_path {folder}/fastcgi;
    scgi_temp_path {folder}/scgi;
    uwsgi_temp_path {folder}/uwsgi;
    include {folder}/gelenk.conf;
}}
"""
"""What Debian's own nginx.conf is for a service of the machine, for a process of its own in a folder."""


def nginx() -> str | None:
    """Where nginx is; Debian installs it where not everybody looks."""
    return shutil.which("nginx", path=f"{os.environ.get('PATH', os.defpath)}:/usr/sbin")


@contextmanager
def in_front_of(service: str, folder: Path) -> Iterator[tuple[str, str, Path]]:
    """The addresses of nginx by TLS and without, and its certificate, which is for 127.0.0.1."""
    key, certificate = folder / "gelenk.key", folder / "gelenk.crt"
    names = ["-subj", f"/CN={NAME}", "-addext", f"subjectAltName=IP:{HOST},DNS:{NAME}"]
    make = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", *names]
    subprocess.run([*make, "-keyout", key, "-out", certificate], check=True, capture_output=True)
    secure, plain = free_port(), free_port()
    places = {
        "server 127.0.0.1:8000;": f"server {urlsplit(service).netloc};",
        "listen 443 ssl": f"listen {HOST}:{secure} ssl",
        "listen 80;": f"listen {HOST}:{plain};",
        "listen [::]:443 ssl http2;": "",
        "listen [::]:80;": "",
        "/etc/nginx/tls/gelenk.crt": str(certificate),
        "/etc/nginx/tls/gelenk.key": str(key),
    }
    text = CONFIGURATION.read_text(encoding="utf-8")
    for place, here in places.items():
        assert text.count(place) == 1, place
        text = text.replace(place, here)
    (folder / "gelenk.conf").write_text(text, encoding="utf-8")
    user = "user root;" if os.geteuid() == 0 else ""  # one without rights could not read this folder
    (folder / "nginx.conf").write_text(_AROUND.format(folder=folder, user=user), encoding="utf-8")
    command = [nginx() or "", "-p", str(folder), "-c", str(folder / "nginx.conf"), "-e", str(folder / "error.log")]
    with subprocess.Popen(command) as run:
        try:
            wait_for(folder / "nginx.pid", run)
            yield f"https://{HOST}:{secure}", f"http://{HOST}:{plain}", certificate
        finally:
            run.terminate()
            run.wait(timeout=60)


def wait_for(pid_file: Path, run: subprocess.Popen[bytes]) -> None:
    """Wait until nginx listens, which it does before it writes its process id."""
    deadline = time.monotonic() + 60
    while not pid_file.exists() or not pid_file.read_text():
        assert run.poll() is None, "nginx has ended"
        assert time.monotonic() < deadline, "nginx does not start"
        time.sleep(0.05)


def trusting(certificate: Path) -> ssl.SSLContext:
    """What a client needs that trusts this certificate and no other."""
    return ssl.create_default_context(cafile=str(certificate))
