/// Bits by logarithms of residuals; parallelograms round a hole before and after.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/removal_judge.h"

#include <cmath>
#include <utility>

namespace meshreel::codecs {

namespace {

constexpr std::uint32_t beyond_border = 0xffffffff;

/// The corner of a triangle that is neither a nor b; beyond_border where the triangle lacks one of them.
std::uint32_t corner_across(const Triangle& t, std::uint32_t a, std::uint32_t b)
{
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t x = t[(i + 1) % 3], y = t[(i + 2) % 3];
        if ((x == a && y == b) || (x == b && y == a)) return t[i];
    }
    return beyond_border;
}

/// The corner across an edge of a patch's triangle i: within the patch, or in the mesh round it, which v is not of.
struct Across {
    std::uint32_t corner = beyond_border;
    bool within = false;
};

Across across(const connectivity::Mesh& mesh, std::uint32_t v, std::span<const Triangle> patch,
              const std::array<std::uint32_t, 3>& edge)
{
    const auto [a, b, i] = edge;
    for (std::size_t j = 0; j < patch.size(); ++j) {
        const std::uint32_t corner = j == i ? beyond_border : corner_across(patch[j], a, b);
        if (corner != beyond_border) return {corner, true};
    }
    for (const std::uint32_t t : mesh.stars.triangles(a == v ? b : a)) {
        const Triangle& beside = mesh.triangles[t];
        if (std::find(beside.begin(), beside.end(), v) != beside.end()) continue;
        const std::uint32_t corner = corner_across(beside, a, b);
        if (corner != beyond_border) return {corner, false};
    }
    return {};
}

} // namespace

RemovalJudge::RemovalJudge(MatrixView<const float> C) : C_(C)
{
    constexpr double precision = 0.001, truncation = 0.65;
    std::vector<double> squares(C.cols);
    double sum = 0;
    for (std::size_t v = 0; v < C.rows; ++v)
        for (std::size_t k = 0; k < C.cols; ++k) squares[k] += static_cast<double>(C(v, k)) * C(v, k);
    for (double square : squares) sum += square;
    const double W = static_cast<double>(C.rows);
    if (sum > 0) step_ = precision * std::sqrt(sum / W);
    const double least = truncation * truncation * step_ * step_ * W;
    const auto matters = [&](double square) { return square >= least; };
    missed_.resize(static_cast<std::size_t>(std::count_if(squares.begin(), squares.end(), matters)));
}

double RemovalJudge::usual_bits(std::span<const connectivity::Gate> gates)
{
    double sum = 0;
    std::size_t count = 0;
    for (std::uint32_t v = 0; v < gates.size(); ++v) {
        const connectivity::Gate& gate = gates[v];
        if (!gate.left.valid() || !gate.right.valid() || !gate.opposite.valid()) continue;
        sum += parallelogram(gate.left.value, gate.right.value, v, gate.opposite.value);
        ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

double RemovalJudge::bits(std::span<const double> missed) const
{
    const double scale = 4.0 / (step_ * step_);
    std::array<double, 4> products{1, 1, 1, 1}; // a logarithm of a product costs less than a sum of logarithms
    double sum = 0;
    for (std::size_t k = 0; k < missed.size(); ++k) {
        products[k % 4] *= 1.0 + scale * missed[k] * missed[k];
        if (k % 32 != 31 && k + 1 != missed.size()) continue;
        for (double& product : products) sum += std::log2(std::exchange(product, 1.0));
    }
    return 0.5 * sum;
}

std::span<const Triangle> RemovalJudge::star(const connectivity::Mesh& mesh, std::uint32_t v)
{
    star_.clear();
    for (const std::uint32_t t : mesh.stars.triangles(v)) star_.push_back(mesh.triangles[t]);
    return star_;
}

double RemovalJudge::parallelograms(const connectivity::Mesh& mesh, std::uint32_t v, std::span<const Triangle> patch)
{
    double sum = 0;
    for (std::uint32_t i = 0; i < patch.size(); ++i)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t a = patch[i][(corner + 1) % 3], b = patch[i][(corner + 2) % 3];
            const Across other = across(mesh, v, patch, {a, b, i});
            const bool counted = other.within && a > b; // from the other side
            if (other.corner == beyond_border || counted) continue;
            sum += parallelogram(a, b, patch[i][corner], other.corner);
        }
    return sum / 3;
}

double RemovalJudge::parallelogram(std::uint32_t left, std::uint32_t right, std::uint32_t tip, std::uint32_t opposite)
{
    const float *a = C_.row(left).data(), *b = C_.row(right).data(), *c = C_.row(tip).data(),
                *d = C_.row(opposite).data();
    for (std::size_t k = 0; k < missed_.size(); ++k)
        missed_[k] = static_cast<double>(a[k]) + b[k] - d[k] - c[k]; // (8.1)
    return bits(missed_);
}

} // namespace meshreel::codecs
