# What choose.cmake makes of drivers that answer, do not answer, or are not there. CHOOSE: that file; WORK: a folder.
include(${CHOOSE})
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})

function(write_program file text)
  file(WRITE ${file} "#!/bin/sh\n${text}\n")
  file(CHMOD ${file} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
endfunction()
write_program(${WORK}/nvcc "printf 'sm_75\\nsm_80\\nsm_90\\nsm_90a\\n'")

function(expect expected nvcc asked environment driver)
  set(PLUMB_NVIDIA_SMI "")
  if(driver)
    set(PLUMB_NVIDIA_SMI ${WORK}/nvidia-smi)
    write_program(${PLUMB_NVIDIA_SMI} "${driver}")
  endif()
  set(ENV{PLUMB_CUDA_ARCHITECTURES} "${environment}")
  set(PLUMB_CUDA_ARCHITECTURES "${asked}")
  plumb_choose_cuda("${nvcc}")
  if(NOT PLUMB_CUDA_ARCHITECTURES STREQUAL expected)
    message(SEND_ERROR "chosen \"${PLUMB_CUDA_ARCHITECTURES}\", expected \"${expected}\" for the driver: ${driver}")
  endif()
endfunction()
set(nvcc ${WORK}/nvcc)
set(h200 "echo 9.0")
expect("" "${nvcc}" "" "" "")                                                # no driver
expect("" "${nvcc}" "" "" "echo 'NVIDIA-SMI 535.86 has failed'; exit 9")     # a driver without a GPU
expect("90-real" "${nvcc}" "" "" "${h200}")
expect("80-real;90-real" "${nvcc}" "" "" "printf '8.0\\n9.0\\n9.0\\n'")      # several GPUs
expect("75-virtual" "${nvcc}" "" "" "echo 12.0")                             # newer than nvcc
expect("" "${nvcc}" "" "" "echo 6.1")                                        # too old
expect("" "" "" "" "${h200}")                                                # no nvcc
expect("" "" "75-virtual" "" "")
expect("75-virtual" "${nvcc}" "" "75-virtual" "")                            # asked for
expect("80-real;90-virtual" "${nvcc}" "80-real;90-virtual" "75-virtual" "${h200}")
expect("" "${nvcc}" "none" "" "${h200}")
expect("" "${nvcc}" "" "none" "${h200}")
