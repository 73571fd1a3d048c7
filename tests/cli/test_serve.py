"""The server of results: what it shows, and what it must not."""

import contextlib
import json
import os
import signal
import socket
import subprocess
import unittest

from program import PROGRAM, ProgramTest
from shapes import box


class Serve(ProgramTest):

    @contextlib.contextmanager
    def served(self, folder):
        """Runs the server; gives its address, ends it by SIGINT and checks its exit code."""
        process = subprocess.Popen([PROGRAM, "serve", folder, "-q"], cwd=self.dir, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        try:
            address = process.stdout.readline().decode().strip()
            self.assertRegex(address, r"^http://127\.0\.0\.1:[0-9]+/$")
            yield address
        finally:
            process.send_signal(signal.SIGINT)
            out, err = process.communicate(timeout=30)
            self.assertEqual((process.returncode, out, err), (0, b"", b""))

    def ask(self, address, path, host=None, method="GET"):
        """Status and body of a request whose path goes out as it is."""
        port = int(address.rstrip("/").rsplit(":", 1)[1])
        with socket.create_connection(("127.0.0.1", port), timeout=30) as connection:
            connection.sendall(f"{method} {path} HTTP/1.1\r\nHost: {host or f'127.0.0.1:{port}'}\r\n"
                               "Connection: close\r\n\r\n".encode())
            answer = b""
            while part := connection.recv(65536):
                answer += part
        head, body = answer.split(b"\r\n\r\n", 1)
        return int(head.split()[1]), head.decode(), body

    def results(self):
        """A folder with two results of view, and a file beside it that is nobody's business."""
        self.write("secret.json", "{}")
        for name, width in (("one", 1.0), ("two", 3.0)):
            model = self.write(f"{name}.off", box(width))
            self.vantage("view", model, "-o", self.dir / "shown" / name, "--size", "64x48", "--no-report")
        return self.dir / "shown"

    def rows(self, body):
        data = body.split(b'id="data">')[1].split(b"</script>")[0]
        return json.loads(data)["rows"]

    def test_a_folder_of_views_is_listed_with_pictures(self):
        with self.served(self.results()) as address:
            status, head, body = self.ask(address, "/")
            self.assertEqual(status, 200)
            self.assertIn("nosniff", head)
            rows = self.rows(body)
            self.assertEqual([row[1] for row in rows], ["one", "two"])
            for row in rows:
                self.assertEqual(row[9], 3)
                for file in ("thumb.png", "best.png"):
                    status, head, body = self.ask(address, f"/models/{row[5]}/{file}")
                    self.assertEqual((status, body[:4]), (200, b"\x89PNG"))
                    self.assertIn("image/png", head)
                    self.assertEqual(body, (self.dir / "shown" / row[5] / "best.png").read_bytes())

    def test_a_single_result_is_shown_under_its_own_name(self):
        folder = self.results() / "two"
        with self.served(folder) as address:
            row, = self.rows(self.ask(address, "/")[2])
            self.assertEqual(self.ask(address, f"/models/{row[5]}/view.json")[2],
                             (folder / "view.json").read_bytes())

    def test_a_batch_is_shown_as_it_is_now(self):
        self.write("a.off", box(1.0))
        self.write("bad.off", "OFF\n")
        self.vantage("batch", "a.off", "bad.off", "-o", "b", "--write", "best", "--size", "64x48", exit_code=4)
        with self.served(self.dir / "b") as address:
            rows = {row[0]: row for row in self.rows(self.ask(address, "/")[2])}
            self.assertEqual((rows["a.off"][2], rows["bad.off"][2]), ("done", "failed"))
            self.assertEqual(self.ask(address, f"/models/{rows['a.off'][5]}/thumb.png")[0], 200)
            self.assertEqual(self.ask(address, "/results.sqlite")[0], 404)
            self.write("c.off", box(2.0))
            self.vantage("batch", "a.off", "bad.off", "c.off", "-o", "b", "--write", "best", "--size", "64x48",
                         exit_code=4)
            self.assertEqual(len(self.rows(self.ask(address, "/index.html")[2])), 3)
            self.assertEqual(self.ask(address, "/index-2.html")[0], 404)

    def test_no_path_leads_out_of_the_folder(self):
        folder = self.results()
        os.symlink(self.dir / "secret.json", folder / "link.json")
        os.symlink(self.dir, folder / "up")
        (folder / ".hidden").mkdir()
        (folder / ".hidden" / "x.json").write_text("{}")
        with self.served(folder) as address:
            for path in ("/../secret.json", "/%2e%2e/secret.json", "/..%2fsecret.json", "/%2e%2e%2fsecret.json",
                         "/one/../../secret.json", "/..\\secret.json", "/models/../secret.json",
                         "/models/../../secret.json", "/models/shown/../secret.json", "//secret.json",
                         f"/{self.dir}/secret.json", f"//{self.dir}/secret.json", "/link.json", "/up/secret.json",
                         "/.hidden/x.json", "/one/./view.json", "/secret.json%00.png", "/one/view.json%00",
                         "/etc/passwd", "/one", "/one/", "/index-1.html", "/index-x.html", "/index-99999999999999999999.html"):
                status, _, body = self.ask(address, path)
                self.assertIn(status, (400, 404), path)
                self.assertNotEqual(body, b"{}", path)
            self.assertEqual(self.ask(address, "/one/view.json")[0], 200)

    def test_it_answers_to_no_other_name_and_to_no_writing(self):
        with self.served(self.results()) as address:
            self.assertEqual(self.ask(address, "/", host="example.com")[0], 403)
            self.assertEqual(self.ask(address, "/", host="127.0.0.1.example.com:80")[0], 403)
            self.assertEqual(self.ask(address, "/", host="localhost:1234")[0], 200)
            for method in ("POST", "PUT", "DELETE"):
                self.assertIn(self.ask(address, "/one/view.json", method=method)[0], (400, 404))

    def test_names_of_models_cannot_become_markup(self):
        folder = self.results()
        view = folder / "one" / "view.json"
        result = json.loads(view.read_text())
        result["model"]["name"] = "</script><script>alert(1)</script>"
        view.write_text(json.dumps(result))
        with self.served(folder) as address:
            body = self.ask(address, "/")[2]
        self.assertNotIn(b"<script>alert", body)
        self.assertEqual(self.rows(body)[0][1], result["model"]["name"])

    def test_a_folder_without_results_is_an_input_error(self):
        (self.dir / "empty").mkdir()
        self.write("empty/view.json", "[]")
        for folder in ("empty", "missing", "empty/view.json"):
            done = self.vantage("serve", folder, exit_code=3)
            self.assertEqual(len(done.err.splitlines()), 1, done.err)

    def test_a_port_that_is_taken_is_said_so(self):
        folder = self.results()
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            done = self.vantage("serve", folder, "--port", taken.getsockname()[1], exit_code=1)
        self.assertIn("--port", done.err)


if __name__ == "__main__":
    unittest.main()
