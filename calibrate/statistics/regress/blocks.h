#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "base/input_error.h"
#include "calibrate/statistics/regress/regression.h"

/// Blocks in the model matrix: b - 1 columns that are 1 in a block, -1 in the last one and 0 in all
/// others. So the shifts add up to 0, and the terms describe the mean of the blocks.
namespace repose::calibrate {

/// Whether values, one of each run, differ between runs of one block.
bool varies_within(const Blocks& blocks, const std::vector<double>& values);

/// Of b blocks, b - 1.
std::size_t block_columns_of(const RunTable& table);

/// Adds every error: a block for each run, two blocks or more, a response that varies within them.
void check_blocks(const RunTable& table, base::Faults& errors);

/// Fills in the last columns of the model matrix.
void add_block_columns(const Blocks& blocks, Eigen::MatrixXd& design);

/// The shifts, without their errors, from the coefficients of those columns; and what the blocks'
/// means explain, before the terms: Montgomery, Design and Analysis of Experiments (8th ed.),
/// sec. 4.1. In a design whose blocks are orthogonal, it is the same after them.
FittedBlocks fitted_blocks(const RunTable& table, const Eigen::VectorXd& values);

/// @param covariance  of the coefficients of the blocks' columns
void set_errors(FittedBlocks& blocks, const Eigen::MatrixXd& covariance);

}  // namespace repose::calibrate
