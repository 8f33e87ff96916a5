//! `compare --format csv`.

use crate::support::twoforms;
use twoforms_estimator::strategy::Strategy;

const HEADER: &str = "receiver,x,y,z,n_x,n_y,n_z,strategy,sampler,samples,replicates,mean_r,mean_g,mean_b,\
                      mean_luminance,error,variance_of_mean,variance_lo,variance_hi,variance_exact,variance_ratio,\
                      variance_ratio_lo,variance_ratio_hi,variance_of_one,\
                      chebyshev_delta,chebyshev_outside,rays,seconds,efficiency,irradiance_known,irradiance_exact,\
                      setup_seconds,strategy_setup_rays,strategy_setup_seconds";

#[test]
fn a_header_then_a_line_for_each_row_with_numbers_that_read_back() {
    let line = "compare @cornell-box --receiver floor-lit --samples 1,16 --replicates 40 --format";
    let csv = twoforms(&format!("{line} csv")).printed();
    let json = twoforms(&format!("{line} json")).json();
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some(HEADER));
    let rows = json["receivers"][0]["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 2 * Strategy::defaults().len());
    for row in rows {
        let cells: Vec<&str> = lines.next().expect("a line").split(',').collect();
        assert_eq!(cells.len(), HEADER.split(',').count());
        assert_eq!(cells[7], row["strategy"]);
        assert_eq!(cells[9].parse().ok(), row["samples"].as_u64());
        assert_eq!(cells[14].parse().ok(), row["mean"]["luminance"].as_f64());
        assert_eq!(cells[15].parse().ok(), row["error"].as_f64());
        assert_eq!(cells[16].parse().ok(), row["variance_of_mean"].as_f64());
    }
    assert_eq!(lines.next(), None);
}
