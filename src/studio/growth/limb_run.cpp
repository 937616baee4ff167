#include "studio/growth/limb_run.h"

#include "base/reason.h"

#include <exception>
#include <utility>

namespace espalier::studio {

LimbRun::LimbRun(std::shared_ptr<const LimbOrder> order, Workers& workers, std::function<void(double)> progressed,
                 Done done)
    : order_(std::move(order)),
      progressed_(std::move(progressed)),
      done_(std::move(done)),
      running_(workers.run([this] { work(); })) {}

LimbRun::~LimbRun() {
    cancelled_ = true;
    running_.wait();
}

void LimbRun::work() {
    try {
        const auto may_continue = [this](double share) {
            if (!cancelled_) progressed_(share);
            return !cancelled_;
        };
        std::string bytes = limb_mesh(*order_, may_continue);
        if (!cancelled_) done_(std::move(bytes), "");
    } catch (const std::exception& error) {
        if (!cancelled_) done_("", reason_of(error));
    }
}

}  // namespace espalier::studio
