# Each line is plain cargo, for those without make. Everything but `lint` shares the release profile.

.PHONY: demo test bench lint

demo:
	cargo run --release --locked --bin fovqa -- score tests/data/small/living-room/gt.png tests/data/small/living-room/rmfr.png \
		--fov-vertical 100 --bands 0,5,10,20,30,45,60 --metrics mse,psnr,ssim,ms-ssim,fpsnr,fssim

test:
	cargo test --release --locked --workspace

bench:
	cargo bench --locked -p fovqa-tests --bench speed

lint:
	cargo fmt --all --check
	cargo clippy --release --locked --workspace --all-targets -- -D warnings
