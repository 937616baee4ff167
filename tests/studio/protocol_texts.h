// What is made from the declared requests and messages of the studio: the page's types, the tables of the manual and
// the words of the fuzzer.
#pragma once

#include "studio/session/message.h"
#include "studio/session/request.h"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <sstream>
#include <string>

namespace studio_test {

using namespace espalier::studio;

/// A request or a message with the types that it holds.
struct Exchange {
    std::string name, help, sends, gets;
};

struct Protocol {
    std::vector<Exchange> requests, messages;
    TypeDescriptions types;
    std::set<std::string> sent;  ///< names of what requests send, and what these hold
};

inline Protocol whole_protocol() {
    Protocol protocol;
    TypeDescriptions sent;
    for (const auto& [name, request] : espalier::registered<RequestType>()) {
        request->sends(sent);
        const std::string sends = request->sends(protocol.types), gets = request->gets(protocol.types);
        protocol.requests.push_back({name, request->help, sends, gets});
    }
    for (const auto& [name, message] : espalier::registered<MessageType>()) {
        protocol.messages.push_back({name, message->help, "", message->content(protocol.types)});
    }
    for (const TypeDescription& type : sent) protocol.sent.insert(type.name);
    std::erase_if(protocol.types, [](const TypeDescription& type) { return type.name == "object"; });
    return protocol;
}

inline std::string bounds_of(const Allowed& allowed) {
    const bool has_lowest = std::isfinite(allowed.lowest), has_highest = std::isfinite(allowed.highest);
    if (has_lowest && has_highest) return fmt::format("{:g} to {:.0f}", allowed.lowest, allowed.highest);
    if (has_lowest) return fmt::format("at least {:g}", allowed.lowest);
    return "";
}

inline std::string with_bounds(const FieldText& field) {
    const std::string bounds = bounds_of(field.allowed);
    return bounds.empty() ? field.help : fmt::format("{}; {}", field.help, bounds);
}

inline std::string typescript(const Protocol& protocol) {
    std::string text =
        "/** The text messages of the studio's protocol. `./dev protocol` makes this file from the declarations in\n"
        " *  src/studio: do not edit it. */\n\n"
        "/** A cell of a table. */\nexport type Cell = number | string | null;\n";
    for (const TypeDescription& type : protocol.types) {
        text += fmt::format("\n/** {}. */\nexport interface {} {{\n", type.help, type.name);
        for (const FieldText& field : type.fields) {
            text += fmt::format("  /** {}. */\n  {}{}: {};\n", with_bounds(field), field.name,
                                field.is_optional ? "?" : "", field.type);
        }
        text += "}\n";
    }
    text += "\n/** What each request sends and gets. */\nexport interface Requests {\n";
    for (const Exchange& request : protocol.requests) {
        text += fmt::format("  /** {}. */\n  \"{}\": {{ send: {}; get: {} }};\n", request.help, request.name,
                            request.sends, request.gets);
    }
    text += "}\n\n/** What the server says without being asked. */\nexport type Said =";
    for (const Exchange& message : protocol.messages) {
        text += fmt::format("\n  | ({{ say: \"{}\" }} & {})", message.name, message.gets);
    }
    return text + ";\n";
}

inline std::string in_cell(std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
    return text;
}

inline std::string manual(const Protocol& protocol) {
    const auto code = [](const std::string& type) { return type == "object" ? "" : "`" + type + "`"; };
    std::string text = "### Requests\n\n| `do` | does | sends | gets |\n|---|---|---|---|\n";
    for (const Exchange& request : protocol.requests) {
        text += fmt::format("| `{}` | {} | {} | {} |\n", request.name, in_cell(request.help), code(request.sends),
                            code(request.gets));
    }
    text += "\n### Messages\n\n| `say` | when and what | holds |\n|---|---|---|\n";
    for (const Exchange& message : protocol.messages) {
        text += fmt::format("| `{}` | {} | {} |\n", message.name, in_cell(message.help), code(message.gets));
    }
    text += "\n### Types\n";
    for (const TypeDescription& type : protocol.types) {
        text += fmt::format("\n**{}**: {}.\n\n| field | type | meaning |\n|---|---|---|\n", type.name, type.help);
        for (const FieldText& field : type.fields) {
            text += fmt::format("| `{}`{} | `{}` | {} |\n", field.name, field.is_optional ? " (may be missing)" : "",
                                in_cell(field.type), in_cell(with_bounds(field)));
        }
    }
    return text;
}

inline std::string dictionary(const Protocol& protocol) {
    std::set<std::string> words;
    for (const Exchange& request : protocol.requests) words.insert(fmt::format("\\\"{}\\\"", request.name));
    for (const TypeDescription& type : protocol.types) {
        if (!protocol.sent.contains(type.name)) continue;
        for (const FieldText& field : type.fields) {
            words.insert(fmt::format("\\\"{}\\\": ", field.name));
            std::istringstream allowed{std::string(field.allowed.words)};
            for (std::string word; allowed >> word;) words.insert(fmt::format("\\\"{}\\\"", word));
        }
    }
    std::string text;
    for (const std::string& word : words) text += fmt::format("\"{}\"\n", word);
    return text;
}

}  // namespace studio_test
