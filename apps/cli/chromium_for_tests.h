#pragma once

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "json.h"

namespace emca::cli {

/// A headless Chromium that a test drives through its DevTools protocol, over a pair of pipes: messages are JSON, each
/// ended by a zero byte. It draws with the processor, has a profile of its own and no network.
class Chromium {
  public:
    /// Where it is installed; empty if it is not.
    static std::string program() {
        for (const char* file : {"/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"})
            if (::access(file, X_OK) == 0) return file;
        return {};
    }

    /// \param extra  further options, "--disable-gpu" for instance
    explicit Chromium(const std::vector<std::string>& extra = {}) {
        std::string pattern = (std::filesystem::temp_directory_path() / "emca-chromium-XXXXXX").string();
        folder_ = ::mkdtemp(pattern.data());
        std::vector<std::string> words{program(), "--headless=new", "--no-sandbox", "--remote-debugging-pipe", "--window-size=1280,800",
                                       "--hide-scrollbars", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-first-run",
                                       "--disable-dev-shm-usage", "--host-resolver-rules=MAP * ~NOTFOUND", "--user-data-dir=" + folder_.string()};
        words.insert(words.end(), extra.begin(), extra.end());
        start(words);
        const Json target = call("Target.createTarget", {{"url", "about:blank"}});
        session_ = call("Target.attachToTarget", {{"targetId", target.value("targetId", "")}, {"flatten", true}}).value("sessionId", "");
        for (const char* domain : {"Page", "Runtime", "Log", "Network"}) call(std::string(domain) + ".enable");
    }
    ~Chromium() {
        call("Browser.close", Json::object(), false);
        ::close(to_);
        ::close(from_);
        ::kill(-child_, SIGKILL);
        ::waitpid(child_, nullptr, 0);
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    Chromium(const Chromium&) = delete;
    Chromium& operator=(const Chromium&) = delete;

    void open(const std::string& url) {
        call("Page.navigate", {{"url", url}});
        until("globalThis.emca !== undefined || document.body && document.body.dataset.failed !== undefined");
    }

    /// The value of an expression of JavaScript in the page; promises are awaited.
    Json evaluate(const std::string& expression) {
        const Json answer = call("Runtime.evaluate", {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}});
        EXPECT_FALSE(answer.contains("exceptionDetails")) << expression << "\n" << answer.dump(2);
        return answer.contains("result") && answer["result"].contains("value") ? answer["result"]["value"] : Json(nullptr);
    }
    /// Waits until an expression is true; fails the test if it does not become so.
    void until(const std::string& expression) {
        for (int i = 0; i < 600 && !session_.empty(); ++i) {
            if (evaluate(expression) == true) return;
            ::usleep(50'000);
        }
        ADD_FAILURE() << "did not become true in the page: " << expression;
    }
    /// Waits for what was asked of the page to be on the screen.
    void settle() { evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))"); }

    void mouse(const std::string& type, double x, double y, int buttons = 0) {
        call("Input.dispatchMouseEvent", {{"type", type}, {"x", x}, {"y", y}, {"button", buttons > 0 || type == "mouseReleased" ? "left" : "none"},
                                          {"buttons", buttons}, {"clickCount", 1}});
    }
    void click(double x, double y) {
        mouse("mouseMoved", x, y);
        mouse("mousePressed", x, y, 1);
        mouse("mouseReleased", x, y);
    }
    void key(const std::string& name) {
        Json event{{"type", "keyDown"}, {"key", name}};
        if (name.size() == 1) event["text"] = name;
        call("Input.dispatchKeyEvent", event);
        call("Input.dispatchKeyEvent", {{"type", "keyUp"}, {"key", name}});
    }
    /// A part of the page as PNG in base64.
    std::string picture(const Json& clip) {
        Json region = clip;
        region["scale"] = 1;
        return call("Page.captureScreenshot", {{"format", "png"}, {"clip", region}})["data"].get<std::string>();
    }
    Json call(const std::string& method, const Json& parameters = Json::object(), bool wait = true) {
        const int id = ++last_;
        Json message{{"id", id}, {"method", method}, {"params", parameters}};
        if (!session_.empty() && method.rfind("Browser.", 0) != 0) message["sessionId"] = session_;
        const std::string text = message.dump();
        if (::write(to_, text.c_str(), text.size() + 1) < 0) ADD_FAILURE() << "Chromium went away";
        while (wait) {
            const Json answer = receive();
            if (answer.is_null()) {
                ADD_FAILURE() << "Chromium did not answer " << method;
                return Json::object();
            }
            if (answer.value("id", 0) != id) continue;
            EXPECT_FALSE(answer.contains("error")) << answer.dump();
            return answer.value("result", Json::object());
        }
        return Json::object();
    }

    std::vector<std::string> complaints;  ///< errors and warnings of the console, uncaught exceptions
    std::vector<std::string> requests;    ///< of the page, whatever for

  private:
    void start(std::vector<std::string>& words) {
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        int in[2], out[2];
        ASSERT_EQ(::pipe(in), 0);
        ASSERT_EQ(::pipe(out), 0);
        ::signal(SIGPIPE, SIG_IGN);
        child_ = ::fork();
        if (child_ == 0) {
            ::setpgid(0, 0);
            // Above 4, where the two that it reads and writes go.
            const int read = ::dup2(in[0], 20), written = ::dup2(out[1], 21);
            ::dup2(read, 3);
            ::dup2(written, 4);
            for (int other = 5; other < 64; ++other) ::close(other);
            ::close(STDERR_FILENO);
            ::execv(argv[0], argv.data());
            ::_exit(127);
        }
        ::close(in[0]);
        ::close(out[1]);
        to_ = in[1];
        from_ = out[0];
    }

    /// The next message; null if none comes for a minute.
    Json receive() {
        for (;;) {
            const std::size_t end = buffer_.find('\0');
            if (end != std::string::npos) {
                const Json message = Json::parse(buffer_.substr(0, end), nullptr, false);
                buffer_.erase(0, end + 1);
                note(message);
                return message;
            }
            pollfd waiting{from_, POLLIN, 0};
            char bytes[65536];
            if (::poll(&waiting, 1, 60'000) <= 0) return nullptr;
            const ssize_t count = ::read(from_, bytes, sizeof bytes);
            if (count <= 0) return nullptr;
            buffer_.append(bytes, static_cast<std::size_t>(count));
        }
    }
    void note(const Json& message) {
        const std::string method = message.value("method", "");
        if (method == "Runtime.exceptionThrown" || method == "Log.entryAdded") complaints.push_back(message["params"].dump());
        if (method == "Runtime.consoleAPICalled" && message["params"]["type"] != "log") complaints.push_back(message["params"].dump());
        if (method == "Network.requestWillBeSent") requests.push_back(message["params"]["request"]["url"]);
    }

    std::filesystem::path folder_;
    std::string buffer_, session_;
    pid_t child_ = -1;
    int to_ = -1, from_ = -1, last_ = 0;
};

}  // namespace emca::cli
