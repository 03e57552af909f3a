// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_table_columns_h
#define voussoir_table_columns_h

#include <voussoir/output/recorders.h>

#include <functional>
#include <utility>

namespace Voussoir
{
  /** Columns of a table, declared by name and by a function that returns the present value. record() adds a row
   * to the table. */
  class TableColumns
  {
  public:
    /** Removes the columns of @p table, which must outlive the object. */
    explicit TableColumns(Table &table) : table(table) { table.columns.clear(); }

    /** Adds a column. @p value returns the present value of the column. */
    void add(const std::string &name, const std::function<double()> &value)
    {
      add(std::vector<std::string>{name}, [value] { return std::vector<double>{value()}; });
    }

    /** Adds several columns. @p values returns one present value for each column. */
    void add(const std::vector<std::string> &names, const std::function<std::vector<double>()> &values)
    {
      table.columns.insert(table.columns.end(), names.begin(), names.end());
      sources.push_back(values);
    }

    /** Adds columns. @p values returns names and present values of the columns, with the same names in each
     * call. */
    void add_named(const std::function<std::vector<std::pair<std::string, double>>()> &values)
    {
      std::vector<std::string> names;
      for (const auto &value : values())
        names.push_back(value.first);
      add(names,
          [values]
          {
            std::vector<double> row;
            for (const auto &value : values())
              row.push_back(value.second);
            return row;
          });
    }

    /** Adds the columns NAME_x, NAME_y and NAME_z. @p value returns the present values of the three columns. */
    void add_vector(const std::string &name, const std::function<Vector3()> &value)
    {
      add({name + "_x", name + "_y", name + "_z"},
          [value]
          {
            const Vector3 v = value();
            return std::vector<double>(v.begin(), v.end());
          });
    }

    /** Adds a row with the present values of all columns to the table. */
    void record()
    {
      std::vector<double> row;
      for (const auto &source : sources)
      {
        const std::vector<double> values = source();
        row.insert(row.end(), values.begin(), values.end());
      }
      table.rows.push_back(row);
    }

  private:
    Table                                            &table;
    std::vector<std::function<std::vector<double>()>> sources;
  };
} // namespace Voussoir

#endif
