// rparam: root systems in the parameters of CRootBox.
#include "espalier/base/file.h"
#include "espalier/language/notation.h"

#include "language/root_box/parameters.h"
#include "language/text/plain_text.h"

namespace espalier::language {
namespace {

TranslatedText translate_rparam(const std::string& text, const std::filesystem::path& path) {
    measured::Notes notes(path.string());
    root_box::RootParameters parameters = root_box::read_by_position(text, path.string(), notes);
    const std::filesystem::path seed = std::filesystem::path(path).replace_extension(".pparam");
    if (is_readable(seed)) {
        const std::string seed_text = read_text(seed);
        require_text(seed_text, seed.string());
        parameters.seed = root_box::read_seed_by_position(with_plain_lines(seed_text), seed.string(), notes);
    }
    std::string model = root_box::model_text(parameters, path.string(), notes);
    return {std::move(model), {}, notes.warnings()};
}

const Registered<NotationType> entry{
    {"rparam", ".rparam", "root systems in the parameters of CRootBox (Schnepf et al. 2018)",
     R"(Parameters of each type of roots, which are read by position, as CRootBox does; what they are called does not count. A file
of the same name that ends in .pparam says when basal roots (type 4) begin; the tap root is of type 1.

    type        1
    name        taproot
    lb          1    0.1
    la          10   0.5
    ln          1    0.2
    lmax        80   5
    r           3    0.3
    a           0.04 0.004
    color       0.6 0.5 0.3
    tropism     1 1.5 0.2
    dx          0.25
    successors  1 2
    successorP  1 1
    theta       0    0
    rlt         1e9  0
    gf          1

Two numbers are a mean and a standard deviation; cm, days and radians. After t days a root is k (1 - exp(-r t / k)) long, or min(k, r t)
with gf 2. Without successors k is lmax; with them there are nob = (lmax - la - lb) / ln + 1 laterals, rounded, at least one, and
k = lb + la + (nob - 1) ln. In place of lmax may stand nob. The model has the settings VARIATION, with 0 for roots without deviations,
WIGGLE, for their turns, and DT.

What has no equal is named by warnings: tropisms other than gravitropism, colours, crowns of shoot-borne roots. The best of N
directions becomes a turn at random and one towards gravity.
A. Schnepf et al.: CRootBox. Annals of Botany 121, 2018.)",
     translate_rparam}};

}  // namespace
}  // namespace espalier::language
