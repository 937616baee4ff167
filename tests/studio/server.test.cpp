// The studio over its sockets: who is let in, and that hostile visitors get nothing.
#include "session_fixture.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <future>
#include <thread>

using namespace studio_test;

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;

const char* const stalk_of_three = "lsystem: 1\nderivation length: 3\naxiom: A\nA --> F(1)A\nendlsystem\n";

/// serve() on a thread of its own.
class Served {
public:
    explicit Served(bool is_recorded = false) {
        options_.folder = folder_.path();
        options_.scratch = scratch_.path();
        options_.opened.path = folder_.write("stalk.l", stalk_of_three);
        if (is_recorded) {
            record(options_.opened.path, 3, folder_.path() / "run");
            options_.opened.path = folder_.path() / "run";
        }
        options_.read = read_as_run;
        options_.library = [] { return std::vector<espalier::studio::LibraryEntry>(); };
        options_.interrupt = &interrupted_;
        std::promise<std::string> address;
        options_.ready = [&](const std::string& text) { address.set_value(text); };
        thread_ = std::thread([this] { espalier::serve(options_); });
        const std::string text = address.get_future().get();
        const std::string before = "http://127.0.0.1:", between = "/#token=";
        port = text.substr(before.size(), text.find(between) - before.size());
        token = text.substr(text.find(between) + between.size());
    }
    ~Served() {
        interrupted_ = true;
        thread_.join();
    }

    std::string host() const { return "127.0.0.1:" + port; }
    tcp::socket connect(asio::io_context& io) const {
        tcp::socket socket(io);
        socket.connect({asio::ip::make_address("127.0.0.1"), static_cast<unsigned short>(std::stoi(port))});
        return socket;
    }

    std::string port, token;

private:
    TemporaryFolder folder_, scratch_;
    espalier::StudioOptions options_;
    std::atomic<bool> interrupted_ = false;
    std::thread thread_;
};

http::response<http::string_body> get(const Served& studio, const std::string& target, const std::string& host,
                                      const std::string& authorization = "", http::verb verb = http::verb::get) {
    asio::io_context io;
    tcp::socket socket = studio.connect(io);
    http::request<http::empty_body> request(verb, target, 11);
    request.set(http::field::host, host);
    if (!authorization.empty()) request.set(http::field::authorization, authorization);
    http::write(socket, request);
    beast::flat_buffer buffer;
    http::response<http::string_body> response;
    http::read(socket, buffer, response);
    return response;
}

/// A page that connects from `origin`; its error if it is not let in.
struct Client {
    asio::io_context io;
    beast::websocket::stream<tcp::socket> socket;
    beast::error_code error;

    Client(const Served& studio, const std::string& origin, const std::string& host) : socket(studio.connect(io)) {
        socket.set_option(beast::websocket::stream_base::decorator(
            [&](beast::websocket::request_type& request) { request.set(http::field::origin, origin); }));
        socket.handshake(host, "/socket", error);
    }

    /// The next text message; null if the connection ended.
    Json read_text() {
        while (true) {
            beast::flat_buffer buffer;
            socket.read(buffer, error);
            if (error) return nullptr;
            if (socket.got_text()) return Json::parse(beast::buffers_to_string(buffer.data()));
        }
    }
    void write(const std::string& text) { socket.write(asio::buffer(text), error); }
};

}  // namespace

TEST_CASE("the page is served with a policy that lets nothing else in", "[studio]") {
    const Served studio;
    const auto page = get(studio, "/", studio.host());
    CHECK(page.result_int() == 200);
    const std::string policy(page["Content-Security-Policy"].data(), page["Content-Security-Policy"].size());
    CHECK(policy.find("default-src 'none'") != std::string::npos);
    CHECK(policy.find("frame-ancestors 'none'") != std::string::npos);
    CHECK(page.body().find(studio.token) == std::string::npos);
    CHECK(get(studio, "/../../etc/passwd", studio.host()).result_int() == 404);
    CHECK(get(studio, "/", studio.host(), "", http::verb::post).result_int() == 405);
}

TEST_CASE("a name that somebody else gave to this machine is refused", "[studio]") {
    const Served studio;
    CHECK(get(studio, "/", "evil.example:" + studio.port).result_int() == 403);
    CHECK(get(studio, "/", "").result_int() == 403);
}

TEST_CASE("files need the token", "[studio]") {
    const Served studio;
    CHECK(get(studio, "/file/1", studio.host()).result_int() == 401);
    CHECK(get(studio, "/file/1", studio.host(), "Bearer 00000000000000000000000000000000").result_int() == 401);
    CHECK(get(studio, "/file/1", studio.host(), "Bearer " + studio.token).result_int() == 404);
}

TEST_CASE("a page of the studio with the token is told what grows", "[studio]") {
    const Served studio;
    Client page(studio, "http://" + studio.host(), studio.host());
    REQUIRE(!page.error);
    page.write(R"({"do": "hello", "id": 1, "token": ")" + studio.token + "\"}");
    CHECK(page.read_text()["reply"] == 1);
    CHECK(page.read_text()["say"] == "document");
}

TEST_CASE("a page is told of a recorded run, and asks for its frames", "[studio]") {
    const Served studio(true);
    Client page(studio, "http://" + studio.host(), studio.host());
    page.write(R"({"do": "hello", "id": 1, "token": ")" + studio.token + "\"}");
    Json message = page.read_text();
    while (!message.is_null() && (message.value("say", "") != "growth" || message["state"] != "done"))
        message = page.read_text();
    REQUIRE(!message.is_null());
    CHECK(message["step"] == 3);
    page.write(R"({"do": "frame", "id": 2, "step": 1, "growth": )" + message["growth"].dump() + "}");
    std::string packet;
    while (packet.substr(0, 4) != "ESP1" || number_at<std::int32_t>(packet, 8) != 1) {
        beast::flat_buffer buffer;
        page.socket.read(buffer, page.error);
        REQUIRE(!page.error);
        packet = beast::buffers_to_string(buffer.data());
    }
    CHECK(number_at<std::uint32_t>(packet, 16) == 1);  // internodes
}

TEST_CASE("a studio ends while pages are open, and they are told", "[studio]") {
    auto studio = std::make_unique<Served>();
    Client page(*studio, "http://" + studio->host(), studio->host());
    page.write(R"({"do": "hello", "id": 1, "token": ")" + studio->token + "\"}");
    CHECK(page.read_text()["reply"] == 1);
    studio.reset();
    while (!page.read_text().is_null()) {
    }
    CHECK(page.error);
}

TEST_CASE("pages of other origins, without the token or with too long a message are turned away", "[studio]") {
    const Served studio;
    Client foreign(studio, "http://evil.example", studio.host());
    CHECK(foreign.error == beast::websocket::error::upgrade_declined);

    Client ignorant(studio, "http://" + studio.host(), studio.host());
    REQUIRE(!ignorant.error);
    ignorant.write(R"({"do": "hello", "id": 1, "token": "guess"})");
    CHECK(ignorant.read_text().is_null());

    Client impolite(studio, "http://" + studio.host(), studio.host());
    impolite.write(R"({"do": "library", "id": 1})");
    CHECK(impolite.read_text().is_null());

    Client verbose(studio, "http://" + studio.host(), studio.host());
    verbose.write(std::string(9 << 20, ' '));
    CHECK(verbose.read_text().is_null());
}

TEST_CASE("another port is another program's, whatever its name", "[studio]") {
    const Served studio;
    const int other = std::stoi(studio.port) ^ 1;
    CHECK(get(studio, "/", "127.0.0.1:" + std::to_string(other)).result_int() == 403);
    CHECK(get(studio, "/", "127.0.0.1").result_int() == 403);
    const std::string host = "localhost:" + std::to_string(other);
    const Client page(studio, "http://" + host, host);
    CHECK(page.error == beast::websocket::error::upgrade_declined);
}

TEST_CASE("first messages that are no greeting end their connection and nothing else", "[studio]") {
    const Served studio;
    const std::string token = "\"token\": \"" + studio.token + "\"";
    std::string nested = R"({"do": "stop", "id": )";
    nested.append(100000, '[');
    for (const std::string& first :
         {std::string(R"({"do":5})"), std::string(R"({"do": "hello", "id": 1, "token": 5})"), nested,
          R"({"do": ["hello"], "id": 1, )" + token + "}", R"({"do": "hello", "id": [[1]], )" + token + "}",
          std::string("[]"), std::string("null"), std::string(), std::string("\xff\xfe"), std::string(5000, ' ')}) {
        INFO(first.substr(0, 80));
        Client page(studio, "http://" + studio.host(), studio.host());
        REQUIRE(!page.error);
        page.write(first);
        CHECK(page.read_text().is_null());
    }
    CHECK(get(studio, "/", studio.host()).result_int() == 200);
}

TEST_CASE("requests that are nested too deep, or whose number is none, are refused in words", "[studio]") {
    const Served studio;
    Client page(studio, "http://" + studio.host(), studio.host());
    page.write(R"({"do": "hello", "id": 1, "token": ")" + studio.token + "\"}");
    REQUIRE(page.read_text()["reply"] == 1);
    const auto refusal = [&](const std::string& request) {
        page.write(request);
        Json message = page.read_text();
        while (!message.is_null() && !message.contains("error")) message = page.read_text();
        return message.value("error", "");
    };
    const std::string deep(2000000, '[');
    CHECK(refusal(R"({"do": "stop", "id": )" + deep + "}") == "the request is nested more than 16 deep");
    CHECK(refusal(R"({"id": 2, "do": "change", "label": )" + deep) == "the request is nested more than 16 deep");
    CHECK(refusal(R"({"do": "stop", "id": "1"})") == "'id' is no whole number");
    CHECK(refusal(R"({"do": "stop", "id": 1.5})") == "'id' is no whole number");
    CHECK(refusal("[1]") == "the request is no object");
    CHECK(refusal(R"({"do": "stop")").starts_with("the request is no JSON"));
}

TEST_CASE("sockets that never greet are closed after five seconds", "[studio]") {
    const Served studio;
    asio::io_context io;
    tcp::socket silent = studio.connect(io);
    Client page(studio, "http://" + studio.host(), studio.host());
    REQUIRE(!page.error);
    const auto begin = std::chrono::steady_clock::now();
    char byte;
    beast::error_code error;
    silent.read_some(asio::buffer(&byte, 1), error);
    CHECK(error);
    CHECK(page.read_text().is_null());
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
    CHECK(waited.count() > 3);
    CHECK(waited.count() < 15);
}

TEST_CASE("however many clients say nothing, the owner's page is served, and stays", "[studio]") {
    const Served studio;
    Client page(studio, "http://" + studio.host(), studio.host());
    page.write(R"({"do": "hello", "id": 1, "token": ")" + studio.token + "\"}");
    CHECK(page.read_text()["reply"] == 1);
    asio::io_context io;
    std::vector<tcp::socket> silent;
    for (int i = 0; i < 300; ++i) silent.push_back(studio.connect(io));
    const auto begin = std::chrono::steady_clock::now();
    CHECK(get(studio, "/", studio.host()).result_int() == 200);
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(4));
    Client another(studio, "http://" + studio.host(), studio.host());
    another.write(R"({"do": "hello", "id": 1, "token": ")" + studio.token + "\"}");
    CHECK(another.read_text()["reply"] == 1);
    page.write(R"({"do": "stop", "id": 7})");
    Json message = page.read_text();
    while (!message.is_null() && message.value("reply", 0) != 7) message = page.read_text();
    CHECK_FALSE(message.is_null());
}
