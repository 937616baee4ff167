// What stands around the plants of a run.
#pragma once

#include "espalier/archive/recorded_run.h"

#include <vtkActor.h>
#include <vtkSmartPointer.h>

namespace espalier::picture {

/// The background scenes of the run's view files; null if there are none. Throws UserError if their file is damaged.
vtkSmartPointer<vtkActor> background_actor(const RecordedRun& run);

}  // namespace espalier::picture
