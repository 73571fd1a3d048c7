"""The server of results: what it shows, and what it must not."""

import contextlib
import http.client
import json
import os
import signal
import socket
import subprocess
import time
import unittest

from program import PROGRAM, ProgramTest
from program import contract_quickly as setUpModule
from shapes import box


VIEW = '{\n  "vantage": "0.1.0", "model": {"name": "one"}, "best": {}}'  # the least that is a result


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

    def test_it_ends_where_nobody_can_read_its_address_and_at_its_time_limit(self):
        self.write("view.json", VIEW)
        for command, code in (("serve . >&-", 1), ("serve . >/dev/full", 75), ("serve . --timeout 0.5", 1)):
            done = subprocess.run(["sh", "-c", f'"$0" {command}', PROGRAM], cwd=self.dir, capture_output=True, timeout=30,
                                  check=False)
            self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(b"--timeout", done.stderr)

    def test_headers_say_once_what_is_so(self):
        self.write("view.json", VIEW)
        with self.served(self.dir) as address:
            head = self.ask(address, "/", method="HEAD")[1]
            self.assertEqual([line for line in head.splitlines() if line.startswith("Accept-Ranges")], ["Accept-Ranges: none"])
            port = int(address.rstrip("/").rsplit(":", 1)[1])
            kept = http.client.HTTPConnection("127.0.0.1", port, timeout=30)
            self.addCleanup(kept.close)
            kept.request("GET", "/")
            self.assertEqual(kept.getresponse().headers["Keep-Alive"], "timeout=5, max=200")

    def test_a_single_result_is_shown_under_its_own_name(self):
        folder = self.results() / "two"
        with self.served(folder) as address:
            row, = self.rows(self.ask(address, "/")[2])
            self.assertEqual(self.ask(address, f"/models/{row[5]}/view.json")[2],
                             (folder / "view.json").read_bytes())

    def test_every_row_leads_to_its_own_result(self):
        whole = self.results() / "one" / "view.json"
        inner = os.fsencode(self.dir / "site")
        folders = [inner, inner + b"/site", inner + b"/caf\xe9 #%25?", inner + "/\u00fc/\u00fc".encode()]
        for number, folder in enumerate(folders):
            os.makedirs(folder)
            result = json.loads(whole.read_text())
            result["model"]["name"] = str(number)
            with open(folder + b"/view.json", "w") as file:
                json.dump(result, file)
        with self.served(self.dir / "site") as address:
            rows = self.rows(self.ask(address, "/")[2])
            self.assertEqual(sorted(row[1] for row in rows), ["0", "1", "2", "3"])
            for row in rows:
                status, _, body = self.ask(address, f"/models/{row[5]}/view.json")
                self.assertEqual((status, json.loads(body)["model"]["name"]), (200, row[1]), row)

    def test_a_browser_opens_a_report_in_a_frame_that_cannot_lead_away(self):
        folder = self.results()
        (folder / "one" / "report.html").write_text("<p>mine")
        with self.served(folder) as address:
            answers = {}
            for wanted in ("document", "iframe"):
                answers[wanted] = self.send(address, f"GET /one/report.html HTTP/1.1\r\nHOST\r\nSec-Fetch-Dest: {wanted}"
                                            "\r\nConnection: close\r\n\r\n".encode()).split(b"\r\n\r\n", 1)
            head, body = answers["document"]
            self.assertIn(b"frame-src 'self'", head)
            self.assertIn(b'<iframe title="report" sandbox="allow-scripts allow-downloads"', body)
            self.assertNotIn(b"mine", body)
            head, body = answers["iframe"]
            self.assertIn(b"; sandbox allow-scripts allow-downloads", head)
            self.assertEqual(body, b"<p>mine")

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
        (folder / "results.data").write_text("{}")
        os.symlink(self.dir / "secret.json", folder / "link.json")
        os.symlink(self.dir, folder / "up")
        (folder / ".hidden").mkdir()
        (folder / ".hidden" / "x.json").write_text("{}")
        os.symlink(".hidden/x.json", folder / "shown.json")
        os.symlink(".hidden", folder / "shown")
        os.symlink("results.data", folder / "data.json")
        os.symlink("one", folder / "also-one")
        os.mkfifo(folder / "pipe.json")
        with self.served(folder) as address:
            for path in ("/../secret.json", "/%2e%2e/secret.json", "/..%2fsecret.json", "/%2e%2e%2fsecret.json",
                         "/one/../../secret.json", "/..\\secret.json", "/models/../secret.json",
                         "/models/../../secret.json", "/models/shown/../secret.json", "//secret.json",
                         f"/{self.dir}/secret.json", f"//{self.dir}/secret.json", "/link.json", "/up/secret.json", "/shown.json", "/shown/x.json",
                         "/data.json", "/also-one/view.json", "/pipe.json", "/models/shown.json",
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
                self.assertIn(self.ask(address, "/one/view.json", method=method)[0], (400, 404, 405))

    def send(self, address, request, timeout=30):
        """All that comes back for these bytes until the server closes the connection."""
        port = int(address.rstrip("/").rsplit(":", 1)[1])
        answer = b""
        with socket.create_connection(("127.0.0.1", port), timeout=timeout) as connection:
            with contextlib.suppress(ConnectionError):
                connection.sendall(request.replace(b"HOST", f"Host: 127.0.0.1:{port}".encode()))
            with contextlib.suppress(ConnectionError):
                while part := connection.recv(65536):
                    answer += part
        return answer

    def test_every_answer_has_a_policy_and_files_are_in_a_sandbox(self):
        folder = self.results()
        (folder / "one" / "evil.html").write_text("<script>fetch('/')</script>")
        (folder / "one" / "report.html").write_text("<script>fetch('/')</script>")
        (folder / "one" / "evil.svg").write_text("<svg xmlns='http://www.w3.org/2000/svg'><script>1</script></svg>")
        with self.served(folder) as address:
            for path in ("/", "/one/evil.html", "/one/report.html", "/one/evil.svg", "/one/best.png", "/one/view.json",
                         "/missing", "/%zz", "/favicon.ico"):
                head = self.ask(address, path)[1]
                policies = [line for line in head.splitlines() if line.startswith("Content-Security-Policy: ")]
                self.assertEqual(len(policies), 1, (path, head))
                self.assertIn("default-src 'none'", policies[0])
                if path != "/":
                    self.assertIn("; sandbox", policies[0], path)
                    self.assertNotIn("allow-same-origin", policies[0])
                if path not in ("/", "/one/report.html"):
                    self.assertNotIn("script", policies[0], path)
            self.assertIn(b"Content-Security-Policy", self.send(address, b"nonsense\r\n\r\n"))
            self.assertIn("Content-Security-Policy", self.ask(address, "/", host="example.com")[1])

    def test_a_part_beyond_the_end_is_refused_and_many_parts_cost_nothing(self):
        folder = self.results()
        size = (folder / "one" / "best.png").stat().st_size
        with self.served(folder) as address:
            for wanted in ("999999999-", f"{size}-", f"{size}-{size}", "-0"):
                for path in ("/one/best.png", "/"):
                    if path == "/" and wanted != "999999999-" and wanted != "-0":
                        continue
                    head, body = self.send(address, f"GET {path} HTTP/1.1\r\nHOST\r\nRange: bytes={wanted}\r\n"
                                           "Connection: close\r\n\r\n".encode()).split(b"\r\n\r\n", 1)
                    self.assertTrue(head.startswith(b"HTTP/1.1 416"), (wanted, head))
                    self.assertIn(b"Content-Length: 0", head)
                    self.assertEqual(body, b"")
            for wanted in ("0-999999999", "5-", "-999999999", ",".join(["0-"] * 2000)):
                head, body = self.send(address, f"GET /one/best.png HTTP/1.1\r\nHOST\r\nRange: bytes={wanted}\r\n"
                                       "Connection: close\r\n\r\n".encode()).split(b"\r\n\r\n", 1)
                self.assertTrue(head.startswith(b"HTTP/1.1 200"), (wanted[:40], head))
                self.assertEqual(len(body), size)
            none = self.send(address, b"GET /one/best.png HTTP/1.1\r\nHOST\r\nRange: bytes=5-2\r\nConnection: close\r\n\r\n")
            self.assertTrue(none.startswith(b"HTTP/1.1 416"), none)

    def test_a_request_larger_than_a_page_needs_is_cut_off(self):
        with self.served(self.results()) as address:
            chunk = b"10000\r\n" + b"x" * 0x10000 + b"\r\n"
            for request in (b"POST / HTTP/1.1\r\nHOST\r\nTransfer-Encoding: chunked\r\n\r\n" + chunk * 64,
                            b"POST / HTTP/1.1\r\nHOST\r\nContent-Length: 99999999\r\n\r\n" + b"x" * 99999):
                answer = self.send(address, request)
                self.assertIn(answer[9:12], (b"405", b""))
                self.assertNotIn(b"200 OK", answer)
            answer = self.send(address, b"GET / HTTP/1.1\r\nHOST\r\n" + b"a: b\r\n" * 200_000)
            self.assertLessEqual(answer.count(b"HTTP/1.1"), 1)
            self.assertNotIn(b"200 OK", answer)
            self.assertEqual(self.ask(address, "/")[0], 200)

    def test_it_ends_at_once_however_many_connections_are_open(self):
        with self.served(self.results()) as address:
            port = int(address.rstrip("/").rsplit(":", 1)[1])
            idle = [socket.create_connection(("127.0.0.1", port)) for _ in range(40)]
            for connection in idle:
                self.addCleanup(connection.close)
            for connection in idle[:8]:
                connection.sendall(b"GET / HTTP/1.1\r\n")  # and then nothing
            time.sleep(0.3)
            started = time.monotonic()
        self.assertLess(time.monotonic() - started, 1.5)

    def test_connections_that_are_kept_open_keep_nobody_waiting(self):
        with self.served(self.results()) as address:
            port = int(address.rstrip("/").rsplit(":", 1)[1])
            started = time.monotonic()
            for _ in range(6):  # what a browser opens and keeps
                connection = socket.create_connection(("127.0.0.1", port))
                self.addCleanup(connection.close)
                connection.sendall(f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n".encode())
                self.assertIn(b"200 OK", connection.recv(65536))
            self.assertEqual(self.ask(address, "/")[0], 200)
            self.assertLess(time.monotonic() - started, 4.0)  # connections are kept for 5

    def test_connections_that_send_nothing_keep_nobody_waiting(self):
        with self.served(self.results()) as address:
            port = int(address.rstrip("/").rsplit(":", 1)[1])
            idle = [socket.create_connection(("127.0.0.1", port)) for _ in range(128)]
            for connection in idle:
                self.addCleanup(connection.close)
            started = time.monotonic()
            self.assertEqual(self.ask(address, "/")[0], 200)
            self.assertLess(time.monotonic() - started, 1.5)
            idle[0].settimeout(10)
            self.assertEqual(idle[0].recv(1), b"")  # closed: it has sent nothing for a second
            self.assertLess(time.monotonic() - started, 4)

    def test_a_request_that_drips_is_cut_off(self):
        with self.served(self.results()) as address:
            port = int(address.rstrip("/").rsplit(":", 1)[1])
            with socket.create_connection(("127.0.0.1", port)) as connection:
                started = time.monotonic()
                with self.assertRaises(ConnectionError):
                    while time.monotonic() - started < 20:
                        connection.sendall(b"G")
                        time.sleep(0.2)
                self.assertLess(time.monotonic() - started, 10.0)

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
        self.write("view.json", VIEW)
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
        with self.served(folder) as address:
            done = self.vantage("serve", folder, "--port", address.rstrip("/").rsplit(":", 1)[1], exit_code=1)
            self.assertIn("--port", done.err)


if __name__ == "__main__":
    unittest.main()
