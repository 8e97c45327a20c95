// A velocity that misbehaves on demand, for tests of what the command makes of it.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <dsc/base/workers.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

// Not known to the compiler, so that it cannot see what is wrong.
int* volatile nowhere = nullptr;
volatile int zero = 0;

void access_nothing() { *nowhere = 1; }

// NOLINTNEXTLINE: the recursion has no end on purpose.
int recurse(int depth) {
    volatile char room[512];
    room[depth % 512] = static_cast<char>(depth);
    return zero == 0 ? recurse(depth + 1) + room[depth % 512] : 0;
}

void damage_heap() {
    char* volatile memory = new char[64];
    std::memset(memory - 16, 0x41, 96);  // also the sizes before and after it
    delete[] memory;
    for (std::size_t i = 1; i < 100; ++i) nowhere = new int[16 * i];
    access_nothing();
}

void read_beyond_a_file() {
    std::FILE* const file = std::tmpfile();
    void* const map = ::mmap(nullptr, 4096, PROT_READ, MAP_SHARED, ::fileno(file), 0);
    zero = *static_cast<volatile char*>(map);
}

// From a child, which is another process.
void get_a_signal() {
    const pid_t self = ::getpid();
    const pid_t child = ::fork();
    if (child == 0) {
        ::kill(self, SIGSEGV);
        ::_exit(0);
    }
    ::pause();
}

void fail() { throw std::runtime_error("nobody catches this"); }
void fail_in_noexcept() noexcept { fail(); }

class Faulty final : public dsc::hooks::VelocityField {
public:
    struct Params {
        std::string fault = "none";
        int step = 1;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.string("fault", &Params::fault).doc("What goes wrong.");
        schema.integer("step", &Params::step).at_least(0, "steps").doc("In which step.");
    }
    Faulty(const Params& params, const dsc::plugin::Setup&) : params_(params) {}
    void prepare(const dsc::hooks::StepContext& context) override {
        now_ = context.step == static_cast<std::uint64_t>(params_.step);
        surface_ = &context.surface;
        if (is("crashes_in_its_loop")) {
            context.workers->for_blocks(1000, 1, [](std::size_t begin, std::size_t) {
                if (begin > 900) access_nothing();
            });
        }
        if (is("crashes_in_its_thread")) std::thread(access_nothing).join();
    }
    void evaluate(dsc::hooks::Range range, std::span<dsc::Vec3> out) const override {
        if (now_) misbehave();
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = -0.01 * surface_->positions[range.begin + i];
            if (is("nan") && range.begin + i == 7)
                out[i].y() = std::numeric_limits<double>::quiet_NaN();
        }
        // One entry behind its last: the memory of whoever calls, if nobody takes care.
        if (is("outside")) out.data()[out.size()] = dsc::Vec3::Zero();
    }

private:
    bool is(std::string_view fault) const { return now_ && params_.fault == fault; }

    void misbehave() const {
        if (is("throws")) throw std::runtime_error("division by zero");
        if (is("exits")) std::exit(0);
        if (is("quick_exits")) std::quick_exit(0);
        if (is("ends")) std::_Exit(0);
        if (is("segfaults")) access_nothing();
        if (is("aborts")) std::abort();
        if (is("divides")) zero = 100 / zero;
        if (is("overflows")) zero = recurse(0);
        if (is("damages_heap")) damage_heap();
        if (is("reads_beyond_a_file")) read_beyond_a_file();
        if (is("executes_nonsense")) ::raise(SIGILL);
        if (is("gets_a_signal")) get_a_signal();
        if (is("terminates")) fail_in_noexcept();
        if (is("prints")) {
            std::puts("** C **");
            std::cout << "** C++ **" << std::endl;
        }
    }

    Params params_;
    bool now_ = false;
    const dsc::surface::SurfaceView* surface_ = nullptr;
};

}  // namespace

DSC_PLUGIN("faulty", "0.3.0", "BSD-3-Clause", "A velocity that misbehaves on demand") {
    registrar.add<Faulty>("faulty", "inwards, with a fault in one step");
}
