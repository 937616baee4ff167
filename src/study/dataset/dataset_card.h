// What a data set tells of itself: for people as README.md, for programs as card.json.
#pragma once

#include "study/dataset/dataset.h"

#include <string>
#include <vector>

namespace espalier::study {

std::string card_json(const DatasetPlan& plan, const std::vector<DatasetSample>& samples,
                      const Dataset::Summary& summary);
std::string card_page(const DatasetPlan& plan, const std::vector<DatasetSample>& samples,
                      const Dataset::Summary& summary);

}  // namespace espalier::study
