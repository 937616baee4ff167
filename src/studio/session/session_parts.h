// A session by its subjects, as requests use it.
#pragma once

#include "studio/growth/workers.h"
#include "studio/session/document_disk.h"
#include "studio/session/fits.h"
#include "studio/session/growths.h"
#include "studio/session/handed_files.h"
#include "studio/session/jobs.h"
#include "studio/session/open_document.h"
#include "studio/session/pages.h"
#include "studio/session/sweeps.h"

namespace espalier::studio {

struct SessionParts {
    SessionParts(const StudioOptions& its_options, const Post& post)
        : options(its_options),
          document(options, pages),
          disk(options, pages, document),
          growths(options, pages, document, disk, files, workers, post),
          jobs(pages, files, workers, post),
          fits(options, pages, document, workers, post),
          sweeps(pages, workers, post) {}

    const StudioOptions& options;
    HandedFiles files;
    Pages pages;
    OpenDocument document;
    DocumentDisk disk;
    Workers workers;
    Growths growths;
    Jobs jobs;
    Fits fits;
    Sweeps sweeps;
};

}  // namespace espalier::studio
