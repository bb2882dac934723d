! A renderer in Fortran with EMCA's calls in it, small enough to show the declarations. docs/c-api.md
!
!     gfortran -std=f2008 -O2 grey.f90 -L… -lemca
module emca
    use, intrinsic :: iso_c_binding
    implicit none
    integer(c_int32_t), parameter :: EMCA_ABI = 65536   ! the version that these declarations are of

    type, bind(c) :: emca_pixel
        integer(c_int32_t) :: x, y
    end type
    type, bind(c) :: emca_vec3f
        real(c_float) :: x, y, z
    end type
    type, bind(c) :: emca_color
        real(c_float) :: r, g, b
    end type
    type, bind(c) :: emca_error
        integer(c_int32_t) :: code
        character(kind=c_char) :: message(508)
    end type
    type, bind(c) :: emca_key
        type(c_ptr) :: text = c_null_ptr, file = c_null_ptr
        integer(c_int32_t) :: line = 0, length = 0
        integer(c_int64_t) :: hash = 0
    end type
    type, bind(c) :: emca_settings
        integer(c_int32_t) :: size, version, samples_per_pixel, has_seed
        integer(c_int64_t) :: seed
        type(c_ptr) :: integrator, sampler
    end type
    type, bind(c) :: emca_image
        integer(c_int32_t) :: size, version, width, height
        type(c_ptr) :: color, samples, variance
        integer(c_int32_t) :: has_samples, has_variance
    end type
    type, bind(c) :: emca_info
        integer(c_int32_t) :: size, version
        type(c_ptr) :: renderer, scene, integrator, sampler
        integer(c_int64_t) :: seed
        integer(c_int32_t) :: width, height, samples_per_pixel, threads, concurrent, deterministic
        integer(c_int32_t) :: paths_reach_any_pixel, capability_count
        type(c_ptr) :: capabilities
    end type
    type, bind(c) :: emca_renderer   ! up to the functions that every renderer has
        integer(c_int32_t) :: size, version
        type(c_ptr) :: user = c_null_ptr
        type(c_funptr) :: info, camera, meshes, render_image, render_pixel
    end type
    type, bind(c) :: emca_server_options
        integer(c_int32_t) :: size, version
        type(c_ptr) :: host = c_null_ptr, token = c_null_ptr
        integer(c_int16_t) :: port = 0, reserved = 0
        integer(c_int32_t) :: allow_quit
    end type

    interface
        function emca_seed(master_seed, pixel, sample) bind(c) result(seed)
            import
            integer(c_int64_t), value :: master_seed, sample
            type(emca_pixel), value :: pixel
            integer(c_int64_t) :: seed
        end function
        function emca_thread_recorder() bind(c) result(recorder)
            import
            type(c_ptr) :: recorder
        end function
        subroutine emca_set_path_index(recorder, sample, part) bind(c)
            import
            type(c_ptr), value :: recorder
            integer(c_int64_t), value :: sample
            integer(c_int32_t), value :: part
        end subroutine
        subroutine emca_set_depth_index(recorder, depth, subpath) bind(c)
            import
            type(c_ptr), value :: recorder
            integer(c_int32_t), value :: depth, subpath
        end subroutine
        subroutine emca_set_intersection_pos(recorder, position) bind(c)
            import
            type(c_ptr), value :: recorder
            type(emca_vec3f), value :: position
        end subroutine
        subroutine emca_add_intersection_float(recorder, key, number) bind(c)
            import
            type(c_ptr), value :: recorder
            type(emca_key) :: key
            real(c_float), value :: number
        end subroutine
        subroutine emca_set_final_estimate(recorder, estimate) bind(c)
            import
            type(c_ptr), value :: recorder
            type(emca_color), value :: estimate
        end subroutine
        function emca_server_start(renderer, options, server, error) bind(c) result(code)
            import
            type(emca_renderer) :: renderer
            type(emca_server_options) :: options
            type(c_ptr) :: server
            type(emca_error) :: error
            integer(c_int32_t) :: code
        end function
        function emca_server_port(server) bind(c) result(port)
            import
            type(c_ptr), value :: server
            integer(c_int16_t) :: port
        end function
        subroutine emca_server_wait(server) bind(c)
            import
            type(c_ptr), value :: server
        end subroutine
        subroutine emca_server_destroy(server) bind(c)
            import
            type(c_ptr), value :: server
        end subroutine
    end interface
end module

module grey
    use emca
    implicit none
    character(kind=c_char, len=*), parameter :: nul = c_null_char
    character(kind=c_char, len=16), target :: renderer_name = "grey in Fortran" // nul
    character(kind=c_char, len=6), target :: scene_name = "noise" // nul, value_name = "value" // nul
    type(emca_key) :: value_key
contains
    function shade(pixel, settings) result(mean)
        type(emca_pixel), intent(in) :: pixel
        type(emca_settings), intent(in) :: settings
        type(emca_color) :: mean
        type(c_ptr) :: recorder
        real(c_float) :: total, number
        integer(c_int64_t) :: i
        recorder = emca_thread_recorder()
        total = 0
        do i = 0, settings%samples_per_pixel - 1
            number = real(iand(emca_seed(settings%seed, pixel, i), 65535_c_int64_t), c_float) / 65536
            if (c_associated(recorder)) then
                call emca_set_path_index(recorder, i, 0)
                call emca_set_depth_index(recorder, 1, 0)
                call emca_set_intersection_pos(recorder, emca_vec3f(real(pixel%x), real(pixel%y), 0.0))
                call emca_add_intersection_float(recorder, value_key, number)
                call emca_set_final_estimate(recorder, emca_color(number, number, number))
            end if
            total = total + number
        end do
        total = total / settings%samples_per_pixel
        mean = emca_color(total, total, total)
    end function

    function info(user, what, error) bind(c) result(code)
        type(c_ptr), value :: user, error
        type(emca_info) :: what
        integer(c_int32_t) :: code
        what%renderer = c_loc(renderer_name)
        what%scene = c_loc(scene_name)
        what%width = 4
        what%height = 3
        what%samples_per_pixel = 2
        code = 0
    end function

    function as_usual(user, what, error) bind(c) result(code)
        type(c_ptr), value :: user, what, error
        integer(c_int32_t) :: code
        code = 0
    end function

    function render_image(user, settings, monitor, image, error) bind(c) result(code)
        type(c_ptr), value :: user, monitor, error
        type(emca_settings) :: settings
        type(emca_image) :: image
        integer(c_int32_t) :: code
        type(emca_color), pointer :: pixels(:, :)
        integer(c_int32_t) :: x, y
        call c_f_pointer(image%color, pixels, [image%width, image%height])
        do y = 1, image%height
            do x = 1, image%width
                pixels(x, y) = shade(emca_pixel(x - 1, y - 1), settings)
            end do
        end do
        code = 0
    end function

    function render_pixel(user, pixel, settings, recording, monitor, color, error) bind(c) result(code)
        type(c_ptr), value :: user, recording, monitor, error
        type(emca_pixel), value :: pixel
        type(emca_settings) :: settings
        type(emca_color) :: color
        integer(c_int32_t) :: code
        color = shade(pixel, settings)
        code = 0
    end function
end module

program serve
    use grey
    implicit none
    type(emca_renderer) :: renderer
    type(emca_server_options) :: options
    type(emca_error) :: error
    type(c_ptr) :: server
    value_key%text = c_loc(value_name)
    renderer%size = int(c_sizeof(renderer), c_int32_t)
    renderer%version = EMCA_ABI
    renderer%info = c_funloc(info)
    renderer%camera = c_funloc(as_usual)
    renderer%meshes = c_funloc(as_usual)
    renderer%render_image = c_funloc(render_image)
    renderer%render_pixel = c_funloc(render_pixel)
    options%size = int(c_sizeof(options), c_int32_t)
    options%version = EMCA_ABI
    options%allow_quit = 1
    if (emca_server_start(renderer, options, server, error) /= 0) then
        print '(508a)', error%message
        stop 1
    end if
    print '(a, i0)', "listening on 127.0.0.1:", iand(int(emca_server_port(server)), 65535)
    flush (6)
    call emca_server_wait(server)
    call emca_server_destroy(server)
end program
