// HTTP and WebSocket on 127.0.0.1; what is said over them is the session's.
#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/studio/studio.h"

#include "base/number.h"
#include "studio/protocol/json.h"
#include "studio/server/access.h"
#include "studio/server/page_files.h"
#include "studio/session/session.h"

#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
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

constexpr std::size_t most_greeting = 4096;                 ///< bytes of a message without the token
constexpr std::size_t most_message = std::size_t(8) << 20;  ///< bytes that a page may send at once
constexpr std::size_t most_unsent = std::size_t(1) << 30;   ///< bytes that a page may leave lying
constexpr seconds patience{5};                              ///< with a client that has not shown the token
constexpr seconds patience_with_pages{600};                 ///< with one that fetches a file
constexpr std::size_t most_strangers = 64;                  ///< clients at once that have not shown the token
constexpr std::size_t most_pages = 32;

/// A client that has not shown the token.
class Stranger {
public:
    virtual ~Stranger() = default;
    virtual void turn_away() = 0;
};

/// What every connection needs.
struct ServerState {
    std::string token;
    int port = 0;
    Session* session = nullptr;  ///< null once the studio ends: connections go after it
    std::deque<std::weak_ptr<Stranger>> strangers = {};
    std::size_t pages = 0;

    /// Whoever comes may make the one who has waited longest go, so that no stranger keeps the owner out.
    void let_in(const std::shared_ptr<Stranger>& stranger) {
        std::erase_if(strangers, [](const auto& known) { return known.expired(); });
        if (strangers.size() >= most_strangers) {
            if (const auto oldest = strangers.front().lock()) oldest->turn_away();
            strangers.pop_front();
        }
        strangers.push_back(stranger);
    }
    void forget(const Stranger& stranger) {
        std::erase_if(strangers, [&](const auto& known) { return known.lock().get() == &stranger; });
    }
};

/// Nothing that a client sends may end the studio: what goes wrong ends this client's connection.
template <class Work>
void contain(const Work& work) {
    try {
        work();
    } catch (const std::exception&) {
        // The connection is gone with the last who held it.
    }
}

/// A page over its WebSocket. It keeps itself alive by what it waits for.
class SocketPage final : public Page, public Stranger, public std::enable_shared_from_this<SocketPage> {
public:
    SocketPage(beast::tcp_stream&& stream, ServerState& state)
        : socket_(std::move(stream)), deadline_(socket_.get_executor()), state_(state) {}
    ~SocketPage() override {
        if (!joined_) return;
        --state_.pages;
        if (state_.session) state_.session->leave(*this);
    }

    void accept(const http::request<http::empty_body>& request) {
        state_.let_in(shared_from_this());
        beast::get_lowest_layer(socket_).expires_never();
        socket_.set_option(websocket::stream_base::timeout{patience, seconds(60), true});
        socket_.read_message_max(most_greeting);
        deadline_.expires_after(patience);
        deadline_.async_wait([self = weak_from_this()](beast::error_code error) {
            const auto page = self.lock();
            if (!error && page && !page->joined_) page->turn_away();
        });
        socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
            if (!error) self->read();
        });
    }

    void turn_away() override {
        beast::error_code ignored;
        beast::get_lowest_layer(socket_).socket().close(ignored);
    }

    void send_text(std::string text) override { send({false, std::move(text)}); }
    void send_bytes(std::string bytes) override { send({true, std::move(bytes)}); }
    bool is_behind() const override { return unsent_.size() > 2; }

private:
    struct Message {
        bool is_binary;
        std::string content;
    };

    void read() {
        socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
            if (!error) contain([&] { self->receive(); });
        });
    }

    void receive() {
        const std::string text = beast::buffers_to_string(buffer_.data());
        buffer_.consume(buffer_.size());
        if (!joined_ && !greets(text)) return close("the key is not that of this studio");
        if (!joined_ && state_.pages >= most_pages) return close("too many pages are open");
        if (!joined_) join();
        state_.session->receive(*this, text);
        read();
    }

    void join() {
        joined_ = true;
        ++state_.pages;
        state_.forget(*this);
        deadline_.cancel();
        socket_.read_message_max(most_message);
        state_.session->join(*this);
    }

    // The first message holds the token.
    bool greets(const std::string& text) const {
        const Json request = read_request(text);
        const std::string token = request.value("token", "");
        return request.value("do", "") == "hello" && is_token(token, state_.token);
    }

    void close(const char* why) {
        socket_.async_close({websocket::close_code::policy_error, why},
                            [self = shared_from_this()](beast::error_code) {});
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
    asio::steady_timer deadline_;  ///< until it has greeted
    ServerState& state_;
    beast::flat_buffer buffer_;
    std::deque<Message> unsent_;
    std::size_t unsent_bytes_ = 0;
    bool joined_ = false;
};

/// A connection that asks for files, until it becomes a page.
class HttpConnection final : public Stranger, public std::enable_shared_from_this<HttpConnection> {
public:
    HttpConnection(tcp::socket&& socket, ServerState& state) : stream_(std::move(socket)), state_(state) {}

    void begin() {
        state_.let_in(shared_from_this());
        read();
    }

    void turn_away() override { stream_.close(); }

private:
    using Request = http::request<http::empty_body>;
    using Response = http::response<http::string_body>;

    void read() {
        parser_.emplace();
        parser_->header_limit(16384);
        stream_.expires_after(patience);
        http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
            if (!error) contain([&] { self->serve(); });
        });
    }

    static std::string_view field(const Request& request, http::field name) {
        const auto value = request[name];
        return {value.data(), value.size()};
    }

    void serve() {
        const Request& request = parser_->get();
        const std::string_view host = field(request, http::field::host);
        const std::string_view target(request.target().data(), request.target().size());
        if (!is_own_host(host, state_.port))
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
        state_.forget(*this);
        std::make_shared<SocketPage>(std::move(stream_), state_)->accept(request);
    }

    void serve_file(const Request& request, std::string_view number) {
        constexpr std::string_view bearer = "Bearer ";
        const std::string_view given = field(request, http::field::authorization);
        if (!given.starts_with(bearer) || !is_token(given.substr(bearer.size()), state_.token)) {
            return answer(http::status::unauthorized, "text/plain", "the token is missing or wrong");
        }
        state_.forget(*this);
        stream_.expires_after(patience_with_pages);
        const auto file = state_.session->file(whole_text_as<std::uint32_t>(number).value_or(0));
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
            if (!error && self->response_.keep_alive()) contain([&] { self->read(); });
        });
    }

    beast::tcp_stream stream_;
    ServerState& state_;
    beast::flat_buffer buffer_;
    std::optional<http::request_parser<http::empty_body>> parser_;
    Response response_;
};

class Server {
public:
    explicit Server(const StudioOptions& options)
        : options_(options), state_{new_token()}, acceptor_(io_), timer_(io_), session_(options, [this](auto work) {
              asio::post(io_, std::move(work));
          }) {
        state_.session = &session_;
        listen();
        state_.port = acceptor_.local_endpoint().port();
    }
    ~Server() { state_.session = nullptr; }
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    void run() {
        const std::string address = fmt::format("http://127.0.0.1:{}/#token={}", state_.port, state_.token);
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
            if (!error) contain([&] { std::make_shared<HttpConnection>(std::move(socket), state_)->begin(); });
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
    ServerState state_;  ///< before what the connections lie in, which leave it when that is destroyed
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
