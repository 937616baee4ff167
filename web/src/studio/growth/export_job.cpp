#include "studio/growth/export_job.h"

#include <utility>

namespace espalier::studio {

std::filesystem::path export_folder(const std::filesystem::path& scratch) {
    return scratch / "export";
}

ExportRun::ExportRun(ExportOrder order, Workers& workers, Progressed progressed, Done done)
    : order_(std::move(order)),
      progressed_(std::move(progressed)),
      done_(std::move(done)),
      running_(
          workers.run([this] { done_({}, "a page writes no files for other programs: `espalier export` does"); })) {}

ExportRun::~ExportRun() = default;

}  // namespace espalier::studio
