/// Views of memory that others own: rows of a matrix, bytes of a file.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace meshreel {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

/// A row-major matrix that someone else owns.
template <class T>
struct MatrixView {
    T* data = nullptr;
    std::size_t rows = 0;
    std::size_t cols = 0;

    std::span<T> row(std::size_t i) const { return {data + i * cols, cols}; }
    T& operator()(std::size_t i, std::size_t j) const { return data[i * cols + j]; }
    std::span<T> values() const { return {data, rows * cols}; }
    operator MatrixView<const T>() const { return {data, rows, cols}; }
};

/// A row-major matrix that owns its values; moves like an int.
template <class T>
struct Matrix {
    std::size_t rows = 0;
    std::size_t cols = 0;
    std::vector<T> values;

    Matrix() = default;
    Matrix(std::size_t row_count, std::size_t col_count) : rows(row_count), cols(col_count), values(rows * cols) {}

    MatrixView<T> view() { return {values.data(), rows, cols}; }
    MatrixView<const T> view() const { return {values.data(), rows, cols}; }
    std::span<T> row(std::size_t i) { return {values.data() + i * cols, cols}; }
    std::span<const T> row(std::size_t i) const { return {values.data() + i * cols, cols}; }
    T& operator()(std::size_t i, std::size_t j) { return values[i * cols + j]; }
    const T& operator()(std::size_t i, std::size_t j) const { return values[i * cols + j]; }
};

} // namespace meshreel
