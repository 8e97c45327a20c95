#pragma once
// A catalogue of strategies that are linked into the test.

#include <algorithm>
#include <list>
#include <tuple>

#include <dsc/plugin/catalogue.hpp>

class FakeCatalogue : public dsc::plugin::Catalogue, public dsc::plugin::Registrar {
public:
    std::optional<dsc::plugin::StrategyInfo> find(dsc::plugin::Kind kind,
                                                  const std::string& id) const override {
        for (const auto& record : records_) {
            if (record.kind == kind && record.id == id)
                return dsc::plugin::StrategyInfo{&record, &info_};
        }
        return std::nullopt;
    }
    std::vector<dsc::plugin::StrategyInfo> list() const override {
        std::vector<dsc::plugin::StrategyInfo> all;
        for (const auto& record : records_) all.push_back({&record, &info_});
        std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
            return std::tie(a.strategy->kind, a.strategy->id) <
                   std::tie(b.strategy->kind, b.strategy->id);
        });
        return all;
    }
    std::vector<dsc::plugin::PluginInfo> plugins() const override { return {info_}; }

private:
    void enroll(dsc::plugin::StrategyRecord record) override {
        records_.push_back(std::move(record));
    }

    std::list<dsc::plugin::StrategyRecord> records_;
    dsc::plugin::PluginInfo info_{"fake", "0.1.0", "MIT", "linked in", "", "", "libdsc_fake.so"};
};
