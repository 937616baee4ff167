// Messages that pages are told without a request. A constant of the type Message declares one, and makes it:
//   const Message<Progress> progress_message{"progress", "how much of some work is done"};
//   pages.broadcast(progress_message({"export", 0.5}));
#pragma once

#include "espalier/base/registry.h"

#include "studio/protocol/description.h"
#include "studio/protocol/json.h"

namespace espalier::studio {

struct MessageType {
    std::string name;  ///< what `say` holds
    std::string help;
    std::string (*content)(TypeDescriptions&);
};

template <Declared Content>
class Message {
public:
    Message(const char* name, const char* help) : entry_({name, help, describe<Content>}) {}

    Json operator()(const Content& content) const {
        Json message{{"say", entry_.name}};
        message.update(json_of(content));
        return message;
    }

private:
    const Registered<MessageType> entry_;
};

}  // namespace espalier::studio
