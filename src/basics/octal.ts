/** Octal digits, at least so many: `octal(10, 4)` is `0012`. */
export function octal(value: number, digits = 1): string {
  return value.toString(8).padStart(digits, '0')
}
