Periodic.v
Kernels.v
Claim_kernel_step.v
Claim_kernel_ramp.v
Claim_kernel_sign.v
Claim_kernel_band.v
