// HTTP and WebSocket on 127.0.0.1; what is said over them is the session's.
#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/studio/studio.h"

#include "studio/access.h"
#include "studio/page_files.h"
#include "studio/session.h"

#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <charconv>
#include <deque>
#include <utility>

namespace espalier::studio {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::size_t most_message = std::size_t(8) << 20;  ///< bytes that a page may send at once
constexpr std::size_t most_unsent = std::size_t(1) << 30;   ///< bytes that a page may leave lying
constexpr int most_connections = 64;

/// What every connection needs.
struct House {
    std::string token;
    Session* session = nullptr;  ///< null once the studio ends: connections go after it
    int connections = 0;
};

/// Counts a connection while it lives.
class Guest {
public:
    explicit Guest(House& house) : house_(house) { ++house_.connections; }
    ~Guest() { --house_.connections; }
    Guest(const Guest&) = delete;
    Guest& operator=(const Guest&) = delete;

    House& house() const { return house_; }

private:
    House& house_;
};

/// A page over its WebSocket. It keeps itself alive by what it waits for.
class SocketPage final : public Page, public std::enable_shared_from_this<SocketPage> {
public:
    SocketPage(beast::tcp_stream&& stream, std::shared_ptr<Guest> guest)
        : socket_(std::move(stream)), guest_(std::move(guest)) {}
    ~SocketPage() override {
        if (house().session) house().session->leave(*this);
    }

    void accept(const http::request<http::empty_body>& request) {
        beast::get_lowest_layer(socket_).expires_never();
        socket_.set_option(websocket::stream_base::timeout{seconds(10), seconds(60), true});
        socket_.read_message_max(most_message);
        socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
            if (!error) self->read();
        });
    }

    void send_text(std::string text) override { send({false, std::move(text)}); }
    void send_bytes(std::string bytes) override { send({true, std::move(bytes)}); }
    bool is_behind() const override { return unsent_.size() > 2; }

private:
    struct Message {
        bool is_binary;
        std::string content;
    };

    House& house() const { return guest_->house(); }

    void read() {
        socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
            if (!error) self->receive();
        });
    }

    void receive() {
        const std::string text = beast::buffers_to_string(buffer_.data());
        buffer_.consume(buffer_.size());
        if (!joined_ && !greets(text)) return close();
        if (!std::exchange(joined_, true)) house().session->join(*this);
        house().session->receive(*this, text);
        read();
    }

    // The first message holds the token.
    bool greets(const std::string& text) const {
        const auto json = nlohmann::json::parse(text, nullptr, false);
        return json.is_object() && json.value("do", "") == "hello" && json.contains("token") &&
               json["token"].is_string() && is_token(json["token"].get<std::string>(), house().token);
    }

    void close() {
        socket_.async_close(websocket::close_code::policy_error, [self = shared_from_this()](beast::error_code) {});
    }

    void send(Message message) {
        unsent_bytes_ += message.content.size();
        if (unsent_bytes_ > most_unsent) return beast::get_lowest_layer(socket_).cancel();
        unsent_.push_back(std::move(message));
        if (unsent_.size() == 1) write();
    }

    void write() {
        socket_.binary(unsent_.front().is_binary);
        socket_.async_write(asio::buffer(unsent_.front().content),
                            [self = shared_from_this()](beast::error_code error, std::size_t) {
                                if (!error) self->written();
                            });
    }

    void written() {
        unsent_bytes_ -= unsent_.front().content.size();
        unsent_.pop_front();
        if (!unsent_.empty()) write();
    }

    websocket::stream<beast::tcp_stream> socket_;
    std::shared_ptr<Guest> guest_;
    beast::flat_buffer buffer_;
    std::deque<Message> unsent_;
    std::size_t unsent_bytes_ = 0;
    bool joined_ = false;
};

/// A connection that asks for files, until it becomes a page.
class Visitor : public std::enable_shared_from_this<Visitor> {
public:
    Visitor(tcp::socket&& socket, House& house) : stream_(std::move(socket)), guest_(std::make_shared<Guest>(house)) {}

    void read() {
        parser_.emplace();
        parser_->header_limit(16384);
        stream_.expires_after(seconds(30));
        http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
            if (!error) self->serve();
        });
    }

private:
    using Request = http::request<http::empty_body>;
    using Response = http::response<http::string_body>;

    static std::string_view field(const Request& request, http::field name) {
        const auto value = request[name];
        return {value.data(), value.size()};
    }

    void serve() {
        const Request& request = parser_->get();
        const std::string_view host = field(request, http::field::host);
        const std::string_view target(request.target().data(), request.target().size());
        if (!is_own_host(host))
            return answer(http::status::forbidden, "text/plain", "this is not a host of the studio");
        if (websocket::is_upgrade(request)) return upgrade(request, host);
        if (request.method() != http::verb::get) return answer(http::status::method_not_allowed, "text/plain", "");
        if (const auto file = page_file(target)) {
            return answer(http::status::ok, file->type, std::string(file->bytes));
        }
        constexpr std::string_view files = "/file/";
        if (!target.starts_with(files)) return answer(http::status::not_found, "text/plain", "there is no such file");
        serve_file(request, target.substr(files.size()));
    }

    void upgrade(const Request& request, std::string_view host) {
        if (!is_own_origin(field(request, http::field::origin), host)) {
            return answer(http::status::forbidden, "text/plain", "this is not a page of the studio");
        }
        std::make_shared<SocketPage>(std::move(stream_), guest_)->accept(request);
    }

    void serve_file(const Request& request, std::string_view number) {
        constexpr std::string_view bearer = "Bearer ";
        const std::string_view given = field(request, http::field::authorization);
        if (!given.starts_with(bearer) || !is_token(given.substr(bearer.size()), guest_->house().token)) {
            return answer(http::status::unauthorized, "text/plain", "the token is missing or wrong");
        }
        std::uint32_t wanted = 0;
        std::from_chars(number.data(), number.data() + number.size(), wanted);
        const auto file = guest_->house().session->file(wanted);
        if (!file) return answer(http::status::not_found, "text/plain", "there is no such file");
        try {
            answer(http::status::ok, "application/octet-stream", read_text(*file));
        } catch (const UserError& error) {
            answer(http::status::not_found, "text/plain", error.what());
        }
    }

    void answer(http::status status, std::string_view type, std::string body) {
        response_ = Response(status, parser_->get().version());
        const auto set = [this](const char* name, std::string_view value) {
            response_.set(name, beast::string_view(value.data(), value.size()));
        };
        set("Content-Type", type);
        set("Cache-Control", "no-store");
        set("X-Content-Type-Options", "nosniff");
        set("Referrer-Policy", "no-referrer");
        set("Cross-Origin-Opener-Policy", "same-origin");
        set("Cross-Origin-Resource-Policy", "same-origin");
        set("Content-Security-Policy",
            "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' blob: data:; "
            "media-src blob:; connect-src 'self' ws://127.0.0.1:* ws://localhost:*; worker-src blob:; "
            "frame-ancestors 'none'; base-uri 'none'; form-action 'none'");
        response_.body() = std::move(body);
        response_.keep_alive(parser_->get().keep_alive());
        response_.prepare_payload();
        http::async_write(stream_, response_, [self = shared_from_this()](beast::error_code error, std::size_t) {
            if (!error && self->response_.keep_alive()) self->read();
        });
    }

    beast::tcp_stream stream_;
    std::shared_ptr<Guest> guest_;
    beast::flat_buffer buffer_;
    std::optional<http::request_parser<http::empty_body>> parser_;
    Response response_;
};

class Server {
public:
    explicit Server(const StudioOptions& options)
        : options_(options), house_{new_token()}, acceptor_(io_), timer_(io_), session_(options, [this](auto work) {
              asio::post(io_, std::move(work));
          }) {
        house_.session = &session_;
        listen();
    }
    ~Server() { house_.session = nullptr; }
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    void run() {
        const std::string address =
            fmt::format("http://127.0.0.1:{}/#token={}", acceptor_.local_endpoint().port(), house_.token);
        accept();
        tick();
        if (options_.ready) options_.ready(address);
        io_.run();
    }

private:
    void listen() {
        try {
            const tcp::endpoint here(asio::ip::make_address_v4("127.0.0.1"), static_cast<std::uint16_t>(options_.port));
            acceptor_.open(here.protocol());
            acceptor_.set_option(asio::socket_base::reuse_address(true));
            acceptor_.bind(here);
            acceptor_.listen();
        } catch (const boost::system::system_error& error) {
            throw RunError(fmt::format("cannot listen on port {}: {}; choose another with --port", options_.port,
                                       error.code().message()));
        }
    }

    void accept() {
        acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
            if (error == asio::error::operation_aborted) return;
            if (!error && house_.connections < most_connections) {
                std::make_shared<Visitor>(std::move(socket), house_)->read();
            }
            accept();
        });
    }

    void tick() {
        if (options_.interrupt && *options_.interrupt) return io_.stop();
        session_.tick();
        timer_.expires_after(milliseconds(100));
        timer_.async_wait([this](beast::error_code) { tick(); });
    }

    const StudioOptions& options_;
    House house_;  ///< before what the connections lie in, which leave it when that is destroyed
    asio::io_context io_{1};
    tcp::acceptor acceptor_;
    asio::steady_timer timer_;
    Session session_;
};

}  // namespace

void serve(const StudioOptions& options) {
    Server(options).run();
}

}  // namespace espalier::studio
