#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of scripts/euroc.sh with a local HTTP server and small archives."""

import functools
import hashlib
import http.server
import io
import os
import subprocess
import tarfile
import threading
import unittest
import zipfile

from folder_case import FolderTest

EUROC = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts", "euroc.sh")
IMAGES = "mav0/cam0/data.csv"


class Server(http.server.SimpleHTTPRequestHandler):
    """Serves files, also from an offset; closes the connection after `broken` bytes unless None."""

    requests = []
    broken = None

    def do_GET(self):
        with open(self.translate_path(self.path), "rb") as file:
            content = file.read()
        offset = int(self.headers.get("Range", "bytes=0-")[len("bytes="):-1])
        if offset >= len(content):
            self.send_error(416)
            return
        self.requests.append((self.path, offset))
        self.send_response(206 if offset else 200)
        if offset:
            self.send_header("Content-Range", f"bytes {offset}-{len(content) - 1}/{len(content)}")
        self.send_header("Content-Length", str(len(content) - offset))
        self.end_headers()
        end = len(content) if self.broken is None else offset + self.broken
        self.wfile.write(content[offset:end])

    def log_message(self, *_):
        pass


def zip_of(**files):
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w") as writer:
        for name, content in files.items():
            writer.writestr(name, content)
    return archive.getvalue()


def sequence_zip(text):
    return zip_of(**{IMAGES: text})


class EurocTest(FolderTest):
    def setUp(self):
        super().setUp()
        for name in ("served", "data"):
            os.mkdir(self.path(name))
        Server.requests, Server.broken = [], None
        server = http.server.ThreadingHTTPServer(
            ("127.0.0.1", 0), functools.partial(Server, directory=self.path("served")))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        self.address = f"http://127.0.0.1:{server.server_port}"
        hall = zip_of(**{"machine_hall/MH_01_easy/MH_01_easy.zip": sequence_zip("one"),
                         "machine_hall/MH_02_easy/MH_02_easy.zip": sequence_zip("two"),
                         "machine_hall/MH_01_easy/MH_01_easy.bag": "a bag"})
        self.serve("hall.zip", hall)
        self.serve("room1.tar", self.tar_of("dataset-room1/" + IMAGES, b"three"))
        self.write("served/room1.tar.md5", self.md5("room1.tar").encode() + b"  room1.tar\n")
        self.table(self.md5("hall.zip"))

    def serve(self, name, content):
        self.write(os.path.join("served", name), content)

    def md5(self, name):
        with open(self.path("served", name), "rb") as file:
            return hashlib.md5(file.read()).hexdigest()

    def table(self, md5):
        self.write("table", (f"# a comment\nMH_* {md5} {self.address}/hall.zip hall.zip\n"
                             f"room1 - {self.address}/room1.tar room1.tar\n").encode())

    @staticmethod
    def tar_of(name, content):
        archive = io.BytesIO()
        with tarfile.open(fileobj=archive, mode="w") as writer:
            entry = tarfile.TarInfo(name)
            entry.size = len(content)
            writer.addfile(entry, io.BytesIO(content))
        return archive.getvalue()

    def call(self, *sequences, exit_code=0):
        result = subprocess.run(
            [EUROC, "--data", self.path("data"), "--output", self.path("output"), "--archives",
             self.path("table"), "--download-only", *sequences],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8", check=False)
        self.assertEqual(result.returncode, exit_code, result.stderr)
        return result

    def assert_unpacked(self, sequence, text):
        with open(self.path("data", sequence, *IMAGES.split("/")), encoding="utf-8") as file:
            self.assertEqual(file.read(), text)

    def test_downloads_each_archive_once_and_announces_the_size(self):
        result = self.call("MH_01_easy", "MH_02_easy", "room1")
        self.assertRegex(result.stdout,
                         r"To download: (hall.zip room1.tar|room1.tar hall.zip), 0 MB")
        self.assert_unpacked("MH_01_easy", "one")
        self.assert_unpacked("MH_02_easy", "two")
        self.assert_unpacked("room1", "three")
        self.assertEqual(sum(path == "/hall.zip" for path, _ in Server.requests), 1)
        Server.requests.clear()
        self.call("MH_01_easy", "room1")
        self.assertEqual(Server.requests, [])

    def test_carries_on_with_an_interrupted_download(self):
        size = os.path.getsize(self.path("served", "hall.zip"))
        with open(self.path("served", "hall.zip"), "rb") as file:
            self.write("data/hall.zip.part", file.read(size // 2))
        self.call("MH_01_easy")
        self.assertIn(("/hall.zip", size // 2), Server.requests)
        self.assert_unpacked("MH_01_easy", "one")

    def test_carries_on_with_a_download_that_lacks_only_the_check(self):
        with open(self.path("served", "hall.zip"), "rb") as file:
            self.write("data/hall.zip.part", file.read())
        self.call("MH_01_easy")
        self.assert_unpacked("MH_01_easy", "one")

    def test_says_that_a_download_broke_off(self):
        Server.broken = 10
        result = self.call("MH_01_easy", exit_code=1)
        self.assertIn("hall.zip: the download was interrupted; run the same command", result.stderr)
        Server.broken = None
        self.call("MH_01_easy")
        self.assert_unpacked("MH_01_easy", "one")

    def test_deletes_a_download_with_a_wrong_checksum(self):
        self.table("0" * 32)
        result = self.call("MH_01_easy", exit_code=1)
        self.assertIn("hall.zip: the MD5 sum is wrong", result.stderr)
        self.assertEqual(os.listdir(self.path("data")), [])

    def test_takes_archives_that_are_there(self):
        self.write("data/MH_03_medium.zip", sequence_zip("alone"))
        self.write("data/hall.zip", b"not used")
        self.call("MH_03_medium")
        self.assert_unpacked("MH_03_medium", "alone")
        self.assertEqual(Server.requests, [])

    def test_names_damaged_archives(self):
        self.write("data/MH_03_medium.zip", b"no zip")
        self.assertIn("MH_03_medium.zip: damaged; delete it",
                      self.call("MH_03_medium", exit_code=1).stderr)
        self.write("data/hall.zip", b"no zip")
        self.assertIn("holds no MH_01_easy.zip, or is damaged",
                      self.call("MH_01_easy", exit_code=1).stderr)
        self.assertFalse(os.path.exists(self.path("data", "MH_01_easy")))

    def test_names_what_it_does_not_know(self):
        self.assertIn("V9_01: no such sequence", self.call("V9_01", exit_code=1).stderr)
        self.assertIn("unknown option --what", self.call("--what", exit_code=1).stderr)

    def test_says_what_to_do_without_a_network(self):
        self.write("table", b"MH_* 0 http://127.0.0.1:1/hall.zip hall.zip\n")
        result = self.call("MH_01_easy", exit_code=1)
        self.assertIn("cannot be reached; put hall.zip or MH_01_easy.zip into", result.stderr)


if __name__ == "__main__":
    unittest.main()
