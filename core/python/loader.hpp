#pragma once
// The loader of strategies that are Python files.

namespace dsc::python {

/// Makes the files loadable by every host of this process.
void register_loader();

}  // namespace dsc::python
