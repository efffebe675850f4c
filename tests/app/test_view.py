"""`holdfast view`: the page that it writes has the results in it, byte by byte; what it refuses."""
import base64
import contextlib
import http.client
import os
import pathlib
import re
import shutil
import signal
import socket
import stat
import subprocess
import time
import unittest

from cli import HOLDFAST, PATIENCE, SEED_ACCELERATION, SEED_LAYOUT, CliTest, wait_for

# Stands in for the page of `make viewer`, which the tests of the program do not need.
PAGE = ('<!doctype html>\n<meta name="generator" content="holdfast viewer">\n<meta content="connect-src data:; base-uri">\n'
        '<body><!--RESULTS--></body>\n')


class ViewTest(CliTest):
    """A program of its own with a page, and small results."""

    def setUp(self):
        super().setUp()
        self.assert_exit(self.run_here("screen", "--quiet", "--layouts", SEED_LAYOUT, "--accelerations",
                                       SEED_ACCELERATION, "-o", "results.h5"), 0)
        self.results = self.folder / "results.h5"
        # A program with a share folder of its own.
        self.program = self.folder / "bin/holdfast"
        self.program.parent.mkdir()
        shutil.copy(HOLDFAST, self.program)
        self.write("share/holdfast/viewer.html", PAGE)

    def view(self, *arguments, **options):
        return self.run_here(*arguments, program=self.program, **options)


class View(ViewTest):
    def embedded(self, path):
        """Name and bytes of the results in a page."""
        found = re.search(r'<script type="text/plain" id="results" data-name="([^"]*)">([^<]*)</script>',
                          path.read_text())
        return found[1], base64.b64decode(found[2], validate=True)

    def test_the_page_beside_the_results_has_their_bytes(self):
        done = self.view("view", "results.h5", "--no-open")
        self.assert_exit(done, 0)
        self.assertEqual(done.stdout, "results.html\n")
        self.assertEqual(self.embedded(self.folder / "results.html"), ("results.h5", self.results.read_bytes()))
        self.assertIn('"connect-src data:; base-uri"', (self.folder / "results.html").read_text())

    def test_a_page_that_says_not_what_it_may_ask_for_is_none_of_the_viewer(self):
        self.write("share/holdfast/viewer.html", PAGE.replace("connect-src", "connect"))
        self.assert_refused(self.view("view", "results.h5", "--no-open"), "viewer.html", "is no page of the viewer", code=1)

    def test_a_page_is_replaced_and_another_file_is_not(self):
        for _ in range(2):
            self.assert_exit(self.view("view", "results.h5", "--no-open", "-o", "page.html"), 0)
        self.write("mine.html", "<p>mine</p>\n")
        self.assert_refused(self.view("view", "results.h5", "--no-open", "-o", "mine.html"), "mine.html")
        self.assertEqual((self.folder / "mine.html").read_text(), "<p>mine</p>\n")

    def test_a_name_with_quotes_stays_a_name(self):
        shutil.copy(self.results, self.folder / 'a "b" <c> & d.h5')
        self.assert_exit(self.view("view", 'a "b" <c> & d.h5', "--no-open", "-o", "page.html"), 0)
        self.assertEqual(self.embedded(self.folder / "page.html")[0], "a &quot;b&quot; &lt;c> &amp; d.h5")

    def test_the_browser_is_asked_to_open_the_page(self):
        asked = self.write("path/xdg-open", '#!/bin/sh\necho "$1" > asked\n')
        asked.chmod(asked.stat().st_mode | stat.S_IXUSR)
        done = self.view("view", "results.h5", env={"PATH": f"{asked.parent}:/usr/bin:/bin"})
        self.assert_exit(done, 0)
        self.assertEqual((self.folder / "asked").read_text(), "results.html\n")

    def test_without_results_it_is_the_page_that_files_are_dropped_on(self):
        done = self.view("view", "--no-open")
        self.assert_exit(done, 0)
        self.assertEqual(done.stdout, "holdfast.html\n")
        self.assertEqual((self.folder / "holdfast.html").read_text(), PAGE)
        self.assert_exit(self.view("view", "--no-open", "-o", "planners.html"), 0)
        self.assertEqual((self.folder / "planners.html").read_text(), PAGE)
        done = self.view("view", "--serve", "--no-open")
        self.assert_exit(done, 2)
        self.assertIn("--serve requires results", done.stderr)

    def test_what_is_no_results_file_is_refused(self):
        self.write("text.h5", "no HDF5\n")
        self.assert_refused(self.view("view", "text.h5", "--no-open"), "text.h5")
        self.assert_refused(self.view("view", "absent.h5", "--no-open"), "absent.h5")

    def test_without_the_page_a_line_says_how_to_get_it(self):
        (self.folder / "share/holdfast/viewer.html").unlink()
        done = self.view("view", "results.h5", "--no-open")
        self.assert_refused(done, "the viewer is not built", "make viewer", "holdfast-viewer", code=1)


class Serve(ViewTest):
    """`--serve`: what the page may ask for, and what nobody else may."""

    def setUp(self):
        super().setUp()
        build = pathlib.Path(HOLDFAST).parents[1]
        plugins = sorted(build.glob("**/libholdfast-page-server.so"))
        if not plugins:
            self.skipTest("built without libmicrohttpd")
        shutil.copy(plugins[0], self.program.parent)
        self.serve("--no-open")

    def serve(self, *arguments, **options):
        """Starts the server that the other methods ask."""
        server = subprocess.Popen([self.program, "view", "--serve", *arguments, "results.h5"], cwd=self.folder,
                                  stdout=subprocess.PIPE, encoding="utf-8", start_new_session=True, **options)
        self.addCleanup(lambda: (os.killpg(server.pid, signal.SIGKILL), server.wait(), server.stdout.close()))
        address = server.stdout.readline().strip()
        self.port, self.token = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/([0-9a-f]{32})/", address).groups()
        return server

    def ask(self, path, method="GET", **headers):
        connection = http.client.HTTPConnection("127.0.0.1", int(self.port), timeout=PATIENCE)
        self.addCleanup(connection.close)
        connection.request(method, path, headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.read(), answer.headers

    def test_the_page_and_its_results(self):
        status, page, _ = self.ask(f"/{self.token}/")
        self.assertEqual(status, 200)
        self.assertIn(b'data-name="results.h5" data-address="results"', page)
        self.assertIn(b"\"connect-src data: 'self'; base-uri\"", page, "it may ask its server")
        # A browser takes packed answers, which would cost the server seconds.
        packed = self.ask(f"/{self.token}/", **{"Accept-Encoding": "gzip, deflate, br"})
        self.assertEqual((packed[1], packed[2]["Content-Encoding"]), (page, None))
        status, whole, _ = self.ask(f"/{self.token}/results")
        self.assertEqual((status, whole), (200, self.results.read_bytes()))

    def test_ranges(self):
        whole = self.results.read_bytes()
        status, _, headers = self.ask(f"/{self.token}/results", "HEAD")
        self.assertEqual((status, int(headers["Content-Length"])), (200, len(whole)))
        for begin, end in ((0, 0), (5, 104), (len(whole) - 7, len(whole) - 1), (0, len(whole) - 1)):
            status, part, headers = self.ask(f"/{self.token}/results", Range=f"bytes={begin}-{end}")
            self.assertEqual((status, part), (206, whole[begin:end + 1]))
            self.assertEqual(headers["Content-Range"], f"bytes {begin}-{end}/{len(whole)}")

    def test_ranges_at_the_end_and_beyond(self):
        whole = self.results.read_bytes()
        size = len(whole)
        for asked, part in {f"{size - 3}-{size + 10**6}": whole[-3:], f"{size - 5}-": whole[-5:], "-7": whole[-7:],
                            f"-{size + 10**6}": whole, f"0-{2**64 - 1}": whole}.items():
            status, answer, headers = self.ask(f"/{self.token}/results", Range=f"bytes={asked}")
            self.assertEqual((status, len(answer)), (206, len(part)), asked)
            self.assertEqual(answer, part, asked)
            self.assertTrue(headers["Content-Range"].endswith(f"/{size}"))
        for asked in (f"{size}-", f"{size}-{size + 5}", f"{2**63}-", "-0"):
            status, answer, headers = self.ask(f"/{self.token}/results", Range=f"bytes={asked}")
            self.assertEqual((status, answer, headers["Content-Range"]), (416, b"", f"bytes */{size}"), asked)
        # What is no range, or several, is answered with the whole (RFC 9110).
        for asked in ("bytes=", "bytes=-", "bytes=5", "bytes=9-4", "bytes=a-b", "bytes=0-1,4-5", "lines=0-1", "bytes=0-99999999999999999999"):
            status, answer, _ = self.ask(f"/{self.token}/results", Range=asked)
            self.assertEqual((status, answer), (200, whole), asked)

    def raw(self, text):
        """What the server answers to bytes; nothing where it closes the connection."""
        with socket.create_connection(("127.0.0.1", int(self.port)), timeout=PATIENCE) as connection:
            connection.sendall(text)
            return b"".join(iter(lambda: connection.recv(1 << 16), b""))

    def test_one_host_is_named(self):
        request = f"GET /{self.token}/results HTTP/1.1\r\n{{}}Connection: close\r\n\r\n"
        here = f"Host: 127.0.0.1:{self.port}\r\n"
        self.assertIn(b" 200 ", self.raw(request.format(here).encode())[:20])
        for hosts in ("", here + here, here + "Host: elsewhere.example\r\n", "Host: elsewhere.example\r\n" + here):
            self.assertRegex(self.raw(request.format(hosts).encode())[:20], b" 40[03] ", hosts)

    def test_bodies_and_long_headers_are_not_read(self):
        host = f"Host: 127.0.0.1:{self.port}\r\n"
        for kind in (f"Content-Length: {10**12}\r\n", "Transfer-Encoding: chunked\r\n"):
            self.assertIn(b" 413 ", self.raw(f"GET /{self.token}/results HTTP/1.1\r\n{host}{kind}\r\n".encode())[:20])
        with contextlib.suppress(ConnectionError):
            self.assertNotIn(b" 200 ", self.raw(f"GET /{self.token}/ HTTP/1.1\r\n{host}X: {'x' * 10**6}\r\n\r\n".encode())[:20])
        self.assertEqual(self.ask(f"/{self.token}/")[0], 200)

    def test_idle_connections_are_in_nobodys_way(self):
        for _ in range(200):
            idle = socket.create_connection(("127.0.0.1", int(self.port)), timeout=PATIENCE)
            self.addCleanup(idle.close)
            idle.sendall(b"GET / HTTP/1.1\r\n")
        begin = time.monotonic()
        self.assertEqual(self.ask(f"/{self.token}/")[0], 200)
        self.assertLess(time.monotonic() - begin, 5)

    def test_it_answers_while_a_browser_runs(self):
        browser = self.write("path/xdg-open", "#!/bin/sh\necho $1 > asked\nexec sleep 600\n")
        browser.chmod(browser.stat().st_mode | stat.S_IXUSR)
        server = self.serve(env={"PATH": f"{browser.parent}:/usr/bin:/bin"})
        wait_for((self.folder / "asked").exists, server)
        self.assertEqual(self.ask(f"/{self.token}/")[0], 200)

    def test_nothing_without_the_token_under_another_name_or_in_writing(self):
        for path in ("/", "/results", "/results.h5", f"/{'0' * 32}/results", f"/{self.token}/../results.h5",
                     f"/{self.token}/config.ini", f"/{self.token}"):
            self.assertEqual(self.ask(path)[0], 404, path)
        self.assertEqual(self.ask(f"/{self.token}/", Host="elsewhere.example")[0], 403)
        for method in ("POST", "PUT", "DELETE"):
            self.assertGreaterEqual(self.ask(f"/{self.token}/results", method)[0], 400, method)

    def test_it_listens_to_this_machine_alone(self):
        listening = pathlib.Path("/proc/net/tcp").read_text().splitlines()[1:]
        addresses = {line.split()[1] for line in listening if line.split()[3] == "0A"}
        self.assertIn(f"0100007F:{int(self.port):04X}", addresses)
        self.assertNotIn(f"00000000:{int(self.port):04X}", addresses)

    def test_a_port_in_use_is_refused(self):
        done = self.view("view", "--serve", "--no-open", "--port", self.port, "results.h5")
        self.assert_refused(done, "port", self.port, code=1)


if __name__ == "__main__":
    unittest.main()
