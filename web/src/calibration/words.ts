export { calibration as say } from "@/technician/language/spoken";
