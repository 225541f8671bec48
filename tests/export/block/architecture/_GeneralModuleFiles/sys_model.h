/* As much of Basilisk's header as a module needs. */
#pragma once
#include <cstdint>

class SysModel {
public:
    virtual ~SysModel() = default;
    virtual void Reset(uint64_t) {}
    virtual void UpdateState(uint64_t) {}
    int64_t moduleID = 0;
};
