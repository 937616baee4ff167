// cplantbox: root systems in the parameters of CPlantBox.
#include "espalier/language/notation.h"

#include "language/root_box/parameters.h"

namespace espalier::language {
namespace {

TranslatedText translate_elements(const std::string& text, const std::filesystem::path& path) {
    measured::Notes notes(path.string());
    const root_box::RootParameters parameters = root_box::read_elements(text, path.string(), notes);
    std::string model = root_box::model_text(parameters, path.string(), notes);
    return {std::move(model), {}, notes.warnings()};
}

const Registered<NotationType> entry{
    {"cplantbox", ".xml", "root systems in the parameters of CPlantBox (Giraud et al. 2023)",
     R"(Parameters of each type of roots, and of the seed, in the XML of CPlantBox:

    <plant><organ type="root" name="taproot" subType="1">
    <parameter name="lmax" value="80" dev="5"/> <parameter name="r" value="3"/>
    <parameter name="successor" type="2" percentage="1"/>
    </organ></plant>

The parameters are those of `.rparam` files, with the same meaning: `espalier list notations rparam`. Of the seed firstB, delayB, maxB and
seedPos.z are read. Stems and leaves are named by a warning.
M. Giraud et al.: CPlantBox: a fully coupled modelling platform for the water and carbon fluxes in the soil-plant-atmosphere continuum.
in silico Plants 5, 2023.)",
     translate_elements, nullptr,
     [](std::string_view head) { return head.find("<organ ") != head.npos || head.find("subType") != head.npos; }}};

}  // namespace
}  // namespace espalier::language
