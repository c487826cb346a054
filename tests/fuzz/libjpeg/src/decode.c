/* Decodes a file with libjpeg's default settings and says whether it complained. */

#include <setjmp.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>
#include <jerror.h>

struct result {
    unsigned width, height, channels;
    unsigned char *samples; /* free() */
    int failed;             /* an error that ends decoding */
    int warnings;           /* without those that change nothing */
    int first_code;         /* number of the error, or else of the first warning */
    char message[JMSG_LENGTH_MAX];
};

struct manager {
    struct jpeg_error_mgr base;
    jmp_buf out;
    struct result *result;
};

static void fail(j_common_ptr info) {
    struct manager *manager = (struct manager *)info->err;
    manager->result->failed = 1;
    manager->result->first_code = info->err->msg_code;
    info->err->format_message(info, manager->result->message);
    longjmp(manager->out, 1);
}

static void emit(j_common_ptr info, int level) {
    struct manager *manager = (struct manager *)info->err;
    if (level >= 0)
        return;
    /* Zeros in the scan header of a sequential file, and a new version of JFIF: harmless. */
    if (info->err->msg_code == JWRN_NOT_SEQUENTIAL || info->err->msg_code == JWRN_JFIF_MAJOR)
        return;
    if (manager->result->warnings++ == 0) {
        manager->result->first_code = info->err->msg_code;
        info->err->format_message(info, manager->result->message);
    }
}

void fovqa_fuzz_decode(const unsigned char *bytes, size_t length, unsigned long most_samples,
                       int in_floats, struct result *result) {
    struct jpeg_decompress_struct info;
    struct manager manager;
    memset(result, 0, sizeof *result);
    memset(&info, 0, sizeof info);
    info.err = jpeg_std_error(&manager.base);
    manager.base.error_exit = fail;
    manager.base.emit_message = emit;
    manager.result = result;
    if (setjmp(manager.out)) {
        jpeg_destroy_decompress(&info);
        return;
    }
    jpeg_create_decompress(&info);
    jpeg_mem_src(&info, bytes, length);
    jpeg_read_header(&info, TRUE);
    /* Inks are converted by the caller. */
    if (info.num_components == 4)
        info.out_color_space = JCS_CMYK;
    else if (info.num_components == 3)
        info.out_color_space = JCS_RGB;
    if (in_floats)
        info.dct_method = JDCT_FLOAT;
    jpeg_calc_output_dimensions(&info);
    result->width = info.output_width;
    result->height = info.output_height;
    result->channels = info.output_components;
    size_t row = (size_t)info.output_width * info.output_components;
    if (row * info.output_height > most_samples) {
        result->failed = 1;
        strcpy(result->message, "too large");
        jpeg_destroy_decompress(&info);
        return;
    }
    result->samples = malloc(row * info.output_height);
    jpeg_start_decompress(&info);
    while (info.output_scanline < info.output_height) {
        JSAMPROW to = result->samples + row * info.output_scanline;
        jpeg_read_scanlines(&info, &to, 1);
    }
    jpeg_finish_decompress(&info);
    jpeg_destroy_decompress(&info);
}
