// The tables that experiments print: for people, for spreadsheets, for programs.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "lab/moments.h"
#include "lab/theory.h"

namespace lavalight {

// A cell of a row; std::monostate where the figure has no meaning in this row.
using Cell = std::variant<std::monostate, std::string, uint64_t, double>;

struct Column {
    std::string key;     // in JSON and CSV
    std::string heading; // for people
};

// Each row has as many cells as there are columns.
struct Table {
    std::string name;  // one word
    std::string title; // what is estimated
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows;
    std::vector<std::string> notes; // what the rows show
};

// Monostate where there is no value.
[[nodiscard]] Cell cellOf(const std::optional<double>& value);

[[nodiscard]] std::string tableText(const Table& table);
// {"name", "title", "columns": [{"key", "heading"}], "rows": [{key: value}], "notes"}; a cell without value
// is null.
[[nodiscard]] nlohmann::ordered_json tableJson(const Table& table);
// All tables as one (RFC 4180): a first column `table`, then every key that any of them has. Notes are left
// out.
[[nodiscard]] std::string tablesCsv(std::span<const Table> tables);

// A row of the kind that nearly every table has.
struct EstimatorRow {
    std::string estimator;
    uint64_t samples = 0;
    double estimate = 0.0;
    std::optional<double> exact;
    double standardError = 0.0;
    double variance = 0.0;        // variance of one sample
    std::optional<double> theory; // variance of one sample, by formula
    double cost = 1.0;            // cost of one sample; the ratio compares at equal cost
    std::vector<Cell> more;       // further columns of this table
};

// The row of samples whose mean and variance have closed forms.
[[nodiscard]] EstimatorRow estimatorRow(std::string name, const Moments& moments, const Theory& theory,
                                        double cost = 1.0);

// Columns estimator, samples, estimate, exact, standard error, variance, theory (where any row has one),
// ratio, and `more`. The first row is the naive one: the ratio is (variance * cost) over that of the first
// row.
[[nodiscard]] Table estimatorTable(std::string name, std::string title, const std::vector<EstimatorRow>& rows,
                                   const std::vector<Column>& more = {});

} // namespace lavalight
