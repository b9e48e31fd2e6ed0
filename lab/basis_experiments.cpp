/// Eigenvalues, predictors of the basis, and the balance of its steps: tables 8.2, 9.2, figures 9.49, 9.50.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <map>
#include <string>

#include "lab/basis_study.h"

namespace meshreel::lab {

namespace {

/// Bits a level, all in one histogram.
double entropy(std::span<const std::int32_t> levels)
{
    std::map<std::int32_t, double> counts;
    for (std::int32_t level : levels) counts[level] += 1;
    double bits = 0;
    for (const auto& [level, count] : counts) bits -= count * std::log2(count / static_cast<double>(levels.size()));
    return bits / static_cast<double>(levels.size());
}

Json residuals_of(const CodedBasis& coded)
{
    return {{"entropy", entropy(coded.levels)}, {"squares", coded.squares}};
}

/// LPC with one set of weights for all vectors.
Choose shared_weights(int order, const BasisStudy& study, double step)
{
    Tape tape;
    const codecs::SeriesPredictor predictor = codecs::code_weights(tape, order, study.basis(), {step});
    return [predictor](std::span<const double>, coding::Quantiser) { return predictor; };
}

/// LPC with weights of its own for each vector.
Choose own_weights(int order)
{
    return [order](std::span<const double> t, coding::Quantiser quantiser) {
        Tape tape;
        return codecs::code_weights(tape, order, {t.data(), 1, t.size()}, quantiser);
    };
}

} // namespace

Result<Json> eigenvalues(const Json& row)
{
    MESHREEL_TRY(const Animation animation, load(row));
    const auto count = row.at("count").get<std::size_t>();
    const linalg::Pca pca = linalg::pca_of_trajectories(frames_of(animation), count, {});
    Json figures{{"eigenvalues", Json::array()}};
    for (double s : pca.singular_values) figures["eigenvalues"].push_back(s * s);
    figures["sum"] = pca.energy;
    figures["all"] = 3 * animation.frame_count();
    figures["vertices"] = animation.vertex_count;
    return figures;
}

Result<Json> predictors(const Json& row)
{
    MESHREEL_TRY(const Animation animation, load(row));
    const BasisStudy study(animation, row.at("bases").get<std::size_t>());
    // A coarser step leaves less entropy: the least negative one that is still enough.
    const codecs::BasisLaw law =
        study.law_where(BasisCoding::cobra, -row.at("cob1").get<double>(), [&](const codecs::BasisLaw& tried) {
            return -entropy(study.code(tried, motion_of(1)).levels);
        });
    Json figures{{"kg_of_exact_basis", study.kg({})}, {"kg", study.kg(study.code(law, motion_of(1)).harm)}};
    for (int order = 1; order <= predict::motion_orders; ++order) {
        const std::string number = std::to_string(order);
        figures["lpc" + number] = residuals_of(study.code(law, shared_weights(order, study, law.step(1))));
        figures["own_lpc" + number] = residuals_of(study.code(law, own_weights(order)));
        figures["cob" + number] = residuals_of(study.code(law, motion_of(order)));
    }
    return figures;
}

Result<Json> tripled(const Json& row)
{
    MESHREEL_TRY(const Animation animation, load(row));
    const BasisStudy study(animation, row.at("bases").get<std::size_t>());
    const auto wanted = row.at("kg").get<double>();
    if (study.kg({}) >= wanted)
        return Error{ErrorCode::usage, "so few basis vectors leave a larger error than asked for", "bases", {}, {}};
    Json figures{{"frames", animation.frame_count()}, {"kg_of_exact_basis", study.kg({})}};
    for (const auto& [name, coding] :
         {std::pair{"uniform", BasisCoding::uniform}, std::pair{"non_uniform", BasisCoding::cobra}}) {
        const auto kg = [&](const codecs::BasisLaw& law, std::size_t i = 0) {
            return study.kg(study.code(law, motion_of(0), i).harm);
        };
        const codecs::BasisLaw law =
            study.law_where(coding, wanted, [&](const codecs::BasisLaw& tried) { return kg(tried); });
        figures[name] = Json{{"before", kg(law)}, {"after", Json::array()}, {"steps", Json::array()}};
        for (std::size_t i = 1; i <= study.bases(); ++i) {
            figures[name]["after"].push_back(kg(law, i));
            figures[name]["steps"].push_back(law.step(i));
        }
    }
    return figures;
}

} // namespace meshreel::lab
