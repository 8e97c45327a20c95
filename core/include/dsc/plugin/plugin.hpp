#pragma once
// The header that the author of a plugin includes.

#include <dsc/base/error.hpp>
#include <dsc/base/log.hpp>
#include <dsc/base/random.hpp>
#include <dsc/config/params.hpp>
#include <dsc/geometry/vec.hpp>
#include <dsc/plugin/catalogue.hpp>
#include <dsc/plugin/entry.hpp>
#include <dsc/plugin/registrar.hpp>
