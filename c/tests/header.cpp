// The header in C++: types, enumerators and linkage.
#include "selfosc.h"

int main()
{
    SelfoscDescribingFunction_f64 df = {};
    const double parameters[] = {1.0};
    const SelfoscStatus status = selfosc_describe_f64(SELFOSC_CHARACTERISTIC_RELAY, parameters, 1, 0.0, 1.0, &df, nullptr);
    SelfoscController_f32 controller = {};
    return status == SELFOSC_STATUS_OK && df.p > 1.2 && selfosc_controller_reset_f32(&controller) == SELFOSC_STATUS_NOT_BEGUN
               ? 0
               : 1;
}
