#include "espalier/base/stop.h"

#include <utility>

namespace espalier {
namespace {

thread_local const StopRequest* request_of_thread = nullptr;

}  // namespace

const StopRequest* StopRequest::current() {
    return request_of_thread;
}

StopRequest::Scope::Scope(const StopRequest* request) : before_(std::exchange(request_of_thread, request)) {}

StopRequest::Scope::~Scope() {
    request_of_thread = before_;
}

void end_if_asked() {
    if (request_of_thread && request_of_thread->is_due()) throw Stopped();
}

}  // namespace espalier
