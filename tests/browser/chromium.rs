//! A headless Chromium with one page, driven over the DevTools protocol.

use std::env;
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tempfile::TempDir;
use tungstenite::{Message, WebSocket, client};

/// How long anything may take before a test fails.
const PATIENCE: Duration = Duration::from_mins(1);

/// A browser that shows a page.
pub(crate) struct Page {
    browser: Child,
    socket: WebSocket<TcpStream>,
    session: String,
    calls: u64,
    /// Whether the button of the pointer is down.
    is_pressed: bool,
    /// What the browser has reported: requests, messages of the log, exceptions.
    events: Vec<Value>,
    _profile: TempDir,
}

/// The program, if it is installed. With `FOVQA_REQUIRE_BROWSER`, it has to be.
fn program() -> Option<PathBuf> {
    let folders = env::var_os("PATH").unwrap_or_default();
    let names = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];
    let found = names.into_iter().find_map(|name| {
        env::split_paths(&folders).map(|folder| folder.join(name)).find(|path| path.is_file())
    });
    if found.is_none() {
        assert!(
            env::var_os("FOVQA_REQUIRE_BROWSER").is_none(),
            "Chromium is not installed; without FOVQA_REQUIRE_BROWSER, tests of pages are skipped"
        );
        #[allow(clippy::print_stderr, reason = "a test that is skipped says so")]
        {
            eprintln!("skipped: Chromium is not installed, so the page is not opened");
        }
    }
    found
}

impl Page {
    /// Opens a file in a window of 1440 x 900 pixels; `None` if no browser is installed.
    pub(crate) fn open(file: &Path) -> Option<Self> {
        let program = program()?;
        let profile = tempfile::tempdir().unwrap();
        let browser = Command::new(program)
            .args(["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"])
            .args(["--no-first-run", "--disable-extensions", "--disable-background-networking"])
            .args(["--disable-component-update", "--window-size=1440,900"])
            .arg("--remote-debugging-port=0")
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .arg("about:blank")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let (port, path) = endpoint(profile.path());
        let stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let (socket, _) = client(format!("ws://127.0.0.1:{port}{path}"), stream).unwrap();
        let session = String::new();
        let (calls, events) = (0, Vec::new());
        let is_pressed = false;
        let mut page =
            Self { browser, socket, session, calls, is_pressed, events, _profile: profile };
        let target = page.call("Target.createTarget", &json!({ "url": "about:blank" }));
        let target = json!({ "targetId": target["targetId"], "flatten": true });
        let attached = page.call("Target.attachToTarget", &target);
        attached["sessionId"].as_str().unwrap().clone_into(&mut page.session);
        for domain in ["Page", "Runtime", "Log", "Network"] {
            page.call(&format!("{domain}.enable"), &json!({}));
        }
        let url = format!("file://{}", file.canonicalize().unwrap().display());
        page.call("Page.navigate", &json!({ "url": url }));
        page.until("document.readyState === 'complete' && location.protocol === 'file:'");
        Some(page)
    }

    /// Calls a method of the protocol and returns its result.
    #[track_caller]
    pub(crate) fn call(&mut self, method: &str, params: &Value) -> Value {
        self.calls += 1;
        let mut call = json!({ "id": self.calls, "method": method, "params": params });
        if !self.session.is_empty() {
            call["sessionId"] = json!(self.session);
        }
        self.socket.send(Message::text(call.to_string())).unwrap();
        loop {
            let Message::Text(text) = self.socket.read().unwrap() else { continue };
            let message: Value = serde_json::from_str(&text).unwrap();
            if message["id"] == json!(self.calls) {
                assert!(message["error"].is_null(), "{method}: {message}");
                return message["result"].clone();
            }
            self.events.push(message);
        }
    }

    /// The value of an expression of JavaScript.
    #[track_caller]
    pub(crate) fn value(&mut self, expression: &str) -> Value {
        let params =
            json!({ "expression": expression, "returnByValue": true, "awaitPromise": true });
        let result = self.call("Runtime.evaluate", &params);
        assert!(result["exceptionDetails"].is_null(), "{expression}: {result}");
        result["result"]["value"].clone()
    }

    /// The text of an expression of JavaScript.
    #[track_caller]
    pub(crate) fn text(&mut self, expression: &str) -> String {
        self.value(&format!("String({expression})")).as_str().unwrap().to_owned()
    }

    /// Waits until an expression is true.
    #[track_caller]
    pub(crate) fn until(&mut self, condition: &str) {
        let begin = Instant::now();
        while self.value(condition) != json!(true) {
            assert!(begin.elapsed() < PATIENCE, "never true: {condition}");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Presses a key, such as `ArrowRight`, with modifiers (1 Alt, 2 Control, 8 Shift).
    pub(crate) fn press(&mut self, key: &str, modifiers: u8) {
        let code = match key {
            "Tab" => 9,
            "Enter" => 13,
            " " => 32,
            "ArrowLeft" => 37,
            "ArrowUp" => 38,
            "ArrowRight" => 39,
            "ArrowDown" => 40,
            other => other.bytes().next().map_or(0, |byte| byte.to_ascii_uppercase()),
        };
        let text = match key {
            "Enter" => Some("\r"),
            one if one.len() == 1 => Some(one),
            _ => None,
        };
        for kind in ["keyDown", "keyUp"] {
            let mut event = json!({
                "type": kind, "key": key, "code": key, "modifiers": modifiers,
                "windowsVirtualKeyCode": code,
            });
            if let Some(text) = text.filter(|_| kind == "keyDown") {
                event["text"] = json!(text);
            }
            self.call("Input.dispatchKeyEvent", &event);
        }
    }

    /// Moves the pointer, or presses (`mousePressed`) or releases (`mouseReleased`) its button.
    pub(crate) fn pointer(&mut self, kind: &str, [x, y]: [f64; 2]) {
        self.is_pressed = match kind {
            "mousePressed" => true,
            "mouseReleased" => false,
            _ => self.is_pressed,
        };
        let buttons = i32::from(self.is_pressed);
        let event = json!({
            "type": kind, "x": x, "y": y, "buttons": buttons, "clickCount": 1,
            "button": if kind == "mouseMoved" && !self.is_pressed { "none" } else { "left" },
        });
        self.call("Input.dispatchMouseEvent", &event);
    }

    /// The middle of an element in the window, after scrolling to it.
    #[track_caller]
    pub(crate) fn middle(&mut self, selector: &str) -> [f64; 2] {
        let expression = format!(
            "(() => {{ const e = document.querySelector({}); \
             e.scrollIntoView({{ block: 'center', behavior: 'instant' }}); \
             const r = e.getBoundingClientRect(); \
             return [r.x + r.width / 2, r.y + r.height / 2]; }})()",
            json!(selector)
        );
        serde_json::from_value(self.value(&expression)).unwrap()
    }

    #[track_caller]
    pub(crate) fn click(&mut self, selector: &str) {
        let at = self.middle(selector);
        for kind in ["mouseMoved", "mousePressed", "mouseReleased"] {
            self.pointer(kind, at);
        }
    }

    /// Chooses an option of a `<select>` by its value.
    #[track_caller]
    pub(crate) fn choose(&mut self, selector: &str, value: &str) {
        let done = self.value(&format!(
            "(() => {{ const s = document.querySelector({}); s.value = {}; \
             s.dispatchEvent(new Event('change', {{ bubbles: true }})); return s.value; }})()",
            json!(selector),
            json!(value)
        ));
        assert_eq!(done, json!(value), "{selector} has this option");
    }

    /// Gives the window a size in pixels and a colour scheme, `light` or `dark`.
    pub(crate) fn show_as(&mut self, [width, height]: [u32; 2], scheme: &str) {
        let size = json!({
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600,
        });
        self.call("Emulation.setDeviceMetricsOverride", &size);
        let features = json!([{ "name": "prefers-color-scheme", "value": scheme }]);
        self.call("Emulation.setEmulatedMedia", &json!({ "features": features }));
    }

    /// Addresses that the page has asked for, other than data in it.
    pub(crate) fn requests(&self) -> Vec<String> {
        let sent =
            self.events.iter().filter(|event| event["method"] == "Network.requestWillBeSent");
        let urls = sent.filter_map(|event| event["params"]["request"]["url"].as_str());
        urls.filter(|url| !url.starts_with("data:")).map(str::to_owned).collect()
    }

    /// What the page has complained of: exceptions, and errors and warnings of the log.
    pub(crate) fn complaints(&self) -> Vec<String> {
        let is_bad = |event: &&Value| match event["method"].as_str() {
            Some("Runtime.exceptionThrown") => true,
            Some("Log.entryAdded") => event["params"]["entry"]["level"] != "info",
            Some("Runtime.consoleAPICalled") => {
                ["error", "warning", "assert"].iter().any(|kind| event["params"]["type"] == *kind)
            }
            _ => false,
        };
        self.events.iter().filter(is_bad).map(Value::to_string).collect()
    }
}

impl Drop for Page {
    fn drop(&mut self) {
        let _ = self.browser.kill();
        let _ = self.browser.wait();
    }
}

/// Port and path of the browser's socket, from the file that it writes.
fn endpoint(profile: &Path) -> (u16, String) {
    let file = profile.join("DevToolsActivePort");
    let begin = Instant::now();
    loop {
        let text = std::fs::read_to_string(&file).unwrap_or_default();
        if let Some((port, path)) = text.trim().split_once('\n') {
            return (port.parse().unwrap(), path.to_owned());
        }
        assert!(begin.elapsed() < PATIENCE, "Chromium does not start");
        std::thread::sleep(Duration::from_millis(20));
    }
}
